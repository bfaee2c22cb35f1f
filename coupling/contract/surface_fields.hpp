#pragma once
// The interface's C++ types to and from the arrays of the wire; the names and shapes are those of proto/surface.proto
// and proto/load.proto. What is received is checked: shapes, checksums, finite values, indices in range.
#include <string>

#include "coupling/contract/surface.hpp"
#include "coupling/transport/field.hpp"

namespace standoff {

Payload to_fields(const SurfaceMesh& mesh);
Payload to_fields(const SurfaceMotion& motion);
Payload to_fields(const SurfaceLoad& load);

SurfaceMesh mesh_from(const Payload& payload, std::int64_t nodes, std::int64_t quads);
/// Into arrays that are kept from window to window: memory that was used before is in the cache and needs no zeros.
void take_motion(const Payload& payload, std::size_t nodes, SurfaceMotion& into);
void take_load(const Payload& payload, std::size_t nodes, SurfaceLoad& into);

/// What identifies a surface: the checksums of its three fields.
std::string surface_digest(const Payload& mesh_fields);
/// What is wrong with a mesh; empty if nothing is.
std::string objection_to(const SurfaceMesh& mesh);
/// "force at node 12 is (nan, 0, 3)"; empty if every value is finite.
std::string not_finite(const std::string& name, const std::vector<Vec3>& values);

}  // namespace standoff
