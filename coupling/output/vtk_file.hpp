#pragma once
// Frames for ParaView: VTU (cells) and VTP (particles) pieces in VTK's XML form 2.2, appended raw data compressed with
// zlib, and the PVD file that strings them into a series. Form 2.2 keeps the node order of 64-node hexahedra as written
// (readers silently permute four nodes of older forms). Positions are written as 32-bit floats: a frame is for the eye.
#include <cstdint>
#include <string>
#include <vector>

#include "coupling/base/vec3.hpp"

namespace standoff {

/// One named array on points or cells; components 1 or 3, values packed point by point.
struct VtkArray {
  std::string name;  // with unit suffix, e.g. "velocity_m_per_s"
  int components = 1;
  std::vector<float> values;
};

VtkArray vtk_array(std::string name, const std::vector<double>& scalars);
VtkArray vtk_array(std::string name, const std::vector<Vec3>& vectors);

struct VtkGrid {
  std::vector<Vec3> points;
  std::vector<std::vector<std::int64_t>> cells;  // node indices in VTK order
  int cell_type = 12;                            // VTK cell type of every cell
  std::vector<VtkArray> point_data, cell_data;
};

/// Unstructured grid piece (.vtu).
std::string vtu_text(const VtkGrid& grid);
/// Point cloud piece (.vtp): every point is a vertex.
std::string vtp_text(const std::vector<Vec3>& points, const std::vector<VtkArray>& point_data);

/// A time series of pieces. Every add() writes the piece and replaces the .pvd, so that a stopped run still opens.
class PvdSeries {
 public:
  /// `folder` is created; pieces are folder/NAME_0000.EXT, the series folder/NAME.pvd.
  PvdSeries(std::string folder, std::string name, std::string extension);
  void add(double time, const std::string& piece_text);
  /// Times of the pieces so far: a series that is continued overwrites what was written after it was saved.
  template <class Archive>
  void archive(Archive& a) {
    a(times_);
  }

 private:
  std::string folder_, name_, extension_;
  std::vector<double> times_;
};

}  // namespace standoff
