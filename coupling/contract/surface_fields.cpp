#include "coupling/contract/surface_fields.hpp"

#include <cmath>
#include <span>

#include <fmt/format.h>

#include "coupling/transport/checksum.hpp"

namespace standoff {
namespace {

// Vec3 is three packed doubles (asserted where it is defined).
std::span<const double> numbers(const std::vector<Vec3>& values) {
  return {reinterpret_cast<const double*>(values.data()), 3 * values.size()};
}
std::span<double> numbers(std::vector<Vec3>& values) {
  return {reinterpret_cast<double*>(values.data()), 3 * values.size()};
}

}  // namespace

Payload to_fields(const SurfaceMesh& mesh) {
  Payload payload;
  payload.add("position", 3, numbers(mesh.position));
  payload.add(
      "quads", 4,
      std::span<const std::int32_t>(mesh.quads.empty() ? nullptr : mesh.quads[0].data(), 4 * mesh.quads.size()));
  payload.add("node_mass", 1, std::span<const double>(mesh.node_mass));
  return payload;
}

Payload to_fields(const SurfaceMotion& motion) {
  Payload payload;
  payload.add("position", 3, numbers(motion.position));
  payload.add("velocity", 3, numbers(motion.velocity));
  return payload;
}

Payload to_fields(const SurfaceLoad& load) {
  Payload payload;
  payload.add("force", 3, numbers(load.force));
  return payload;
}

SurfaceMesh mesh_from(const Payload& payload, std::int64_t nodes, std::int64_t quads) {
  // Sizes were held against the frames on arrival, so what is allocated here has really been received.
  for (const FieldDescriptor& field : payload.fields)
    if (field.shape.count != (field.shape.name == "quads" ? quads : nodes))
      throw ProtocolError(fmt::format("the surface announces {} nodes and {} quads, its field \"{}\" has {} items",
                                      nodes, quads, field.shape.name, field.shape.count));
  if (payload.fields.size() != 3) throw ProtocolError("the surface needs the fields position, quads and node_mass");
  SurfaceMesh mesh;
  mesh.position.resize(static_cast<std::size_t>(nodes));
  mesh.quads.resize(static_cast<std::size_t>(quads));
  mesh.node_mass.resize(static_cast<std::size_t>(nodes));
  payload.take("position", 3, numbers(mesh.position));
  payload.take("quads", 4,
               std::span<std::int32_t>(mesh.quads.empty() ? nullptr : mesh.quads[0].data(), 4 * mesh.quads.size()));
  payload.take("node_mass", 1, std::span<double>(mesh.node_mass));
  if (const std::string objection = objection_to(mesh); !objection.empty()) throw ProtocolError(objection);
  return mesh;
}

void take_motion(const Payload& payload, std::size_t nodes, SurfaceMotion& into) {
  into.position.resize(nodes);
  into.velocity.resize(nodes);
  payload.take("position", 3, numbers(into.position));
  payload.take("velocity", 3, numbers(into.velocity));
}

void take_load(const Payload& payload, std::size_t nodes, SurfaceLoad& into) {
  into.force.resize(nodes);
  payload.take("force", 3, numbers(into.force));
}

std::string surface_digest(const Payload& mesh_fields) {
  std::string digest;
  for (const FieldDescriptor& field : mesh_fields.fields) digest += fmt::format("{:08x}", field.checksum);
  return digest;
}

std::string objection_to(const SurfaceMesh& mesh) {
  const std::size_t nodes = mesh.position.size();
  if (nodes == 0 || mesh.quads.empty()) return "a surface without nodes or quads";
  if (mesh.node_mass.size() != nodes)
    return fmt::format("a surface with {} nodes and {} nodal masses", nodes, mesh.node_mass.size());
  if (const std::string text = not_finite("surface position", mesh.position); !text.empty()) return text;
  for (std::size_t i = 0; i < nodes; ++i)
    if (!(mesh.node_mass[i] > 0.0) || !std::isfinite(mesh.node_mass[i]))
      return fmt::format("surface node {} has a mass of {} kg", i, mesh.node_mass[i]);
  for (std::size_t q = 0; q < mesh.quads.size(); ++q)
    for (const std::int32_t node : mesh.quads[q])
      if (node < 0 || static_cast<std::size_t>(node) >= nodes)
        return fmt::format("surface quad {} has a corner {}, the surface has nodes 0 .. {}", q, node, nodes - 1);
  return {};
}

std::string not_finite(const std::string& name, const std::vector<Vec3>& values) {
  if (values.empty() || all_finite(values.data(), 3 * values.size())) return {};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Vec3& v = values[i];
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
      return fmt::format("{} at node {} is ({}, {}, {})", name, i, v.x, v.y, v.z);
  }
  return {};
}

}  // namespace standoff
