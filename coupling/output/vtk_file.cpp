#include "coupling/output/vtk_file.hpp"

#include <algorithm>
#include <filesystem>
#include <span>

#include <fmt/format.h>
#include <zlib.h>

#include "coupling/base/stop.hpp"
#include "coupling/output/atomic_file.hpp"

namespace standoff {
namespace {

constexpr std::size_t block_bytes = 1u << 20;  // uncompressed bytes of one zlib block

template <class T>
constexpr const char* vtk_type() {
  if constexpr (std::is_same_v<T, float>) return "Float32";
  if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

template <class T>
void append_raw(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Collects arrays: the XML head refers to offsets in the appended section.
class AppendedData {
 public:
  /// Adds an array and returns its <DataArray .../> element.
  template <class T>
  std::string add(const std::string& name, int components, std::span<const T> values) {
    const std::string element =
        fmt::format(R"(<DataArray type="{}" Name="{}" NumberOfComponents="{}" format="appended" offset="{}"/>)",
                    vtk_type<T>(), name, components, bytes_.size());
    append(reinterpret_cast<const unsigned char*>(values.data()), values.size_bytes());
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  /// VTK's layout: [blocks][block size][last block size][compressed sizes...] as UInt64, then the blocks.
  void append(const unsigned char* data, std::size_t size) {
    const std::uint64_t blocks = (size + block_bytes - 1) / block_bytes;
    std::string sizes, packed;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const std::size_t begin = b * block_bytes, length = std::min(block_bytes, size - begin);
      std::vector<unsigned char> block(compressBound(length));
      uLongf used = block.size();
      if (compress2(block.data(), &used, data + begin, length, 1) != Z_OK)
        throw Stop(ExitCode::out_of_resources, "zlib could not compress an output frame: out of memory");
      append_raw(sizes, std::uint64_t{used});
      packed.append(reinterpret_cast<const char*>(block.data()), used);
    }
    append_raw(bytes_, blocks);
    append_raw(bytes_, std::uint64_t{block_bytes});
    append_raw(bytes_, std::uint64_t{size % block_bytes});
    bytes_ += sizes + packed;
  }
  std::string bytes_;
};

std::string arrays_text(AppendedData& data, const char* section, const std::vector<VtkArray>& arrays) {
  std::string text = fmt::format("<{}>\n", section);
  for (const VtkArray& a : arrays) text += data.add(a.name, a.components, std::span<const float>(a.values)) + "\n";
  return text + fmt::format("</{}>\n", section);
}

std::string points_text(AppendedData& data, const std::vector<Vec3>& points) {
  const VtkArray array = vtk_array("Points", points);
  return "<Points>\n" + data.add(array.name, 3, std::span<const float>(array.values)) + "\n</Points>\n";
}

std::string file_text(const char* type, const std::string& piece, const AppendedData& data) {
  return fmt::format(
             "<?xml version=\"1.0\"?>\n<VTKFile type=\"{0}\" version=\"2.2\" byte_order=\"LittleEndian\" "
             "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<{0}>\n{1}</{0}>\n"
             "<AppendedData encoding=\"raw\">\n_",
             type, piece) +
         data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

VtkArray vtk_array(std::string name, const std::vector<double>& scalars) {
  return {std::move(name), 1, std::vector<float>(scalars.begin(), scalars.end())};
}

VtkArray vtk_array(std::string name, const std::vector<Vec3>& vectors) {
  VtkArray array{std::move(name), 3, {}};
  array.values.reserve(3 * vectors.size());
  for (const Vec3& v : vectors)
    for (const double c : {v.x, v.y, v.z}) array.values.push_back(static_cast<float>(c));
  return array;
}

std::string vtu_text(const VtkGrid& grid) {
  std::vector<std::int64_t> connectivity, offsets;
  for (const auto& cell : grid.cells) {
    connectivity.insert(connectivity.end(), cell.begin(), cell.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const std::vector<std::uint8_t> types(grid.cells.size(), static_cast<std::uint8_t>(grid.cell_type));
  AppendedData data;
  std::string piece =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points.size(), grid.cells.size());
  piece += points_text(data, grid.points) + "<Cells>\n";
  piece += data.add("connectivity", 1, std::span<const std::int64_t>(connectivity)) + "\n";
  piece += data.add("offsets", 1, std::span<const std::int64_t>(offsets)) + "\n";
  piece += data.add("types", 1, std::span<const std::uint8_t>(types)) + "\n</Cells>\n";
  piece +=
      arrays_text(data, "PointData", grid.point_data) + arrays_text(data, "CellData", grid.cell_data) + "</Piece>\n";
  return file_text("UnstructuredGrid", piece, data);
}

std::string vtp_text(const std::vector<Vec3>& points, const std::vector<VtkArray>& point_data) {
  std::vector<std::int64_t> connectivity(points.size()), offsets(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    connectivity[i] = static_cast<std::int64_t>(i);
    offsets[i] = static_cast<std::int64_t>(i + 1);
  }
  AppendedData data;
  std::string piece = fmt::format(
      "<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
      "NumberOfPolys=\"0\">\n",
      points.size());
  piece += points_text(data, points) + "<Verts>\n";
  piece += data.add("connectivity", 1, std::span<const std::int64_t>(connectivity)) + "\n";
  piece += data.add("offsets", 1, std::span<const std::int64_t>(offsets)) + "\n</Verts>\n";
  piece += arrays_text(data, "PointData", point_data) + "</Piece>\n";
  return file_text("PolyData", piece, data);
}

PvdSeries::PvdSeries(std::string folder, std::string name, std::string extension)
    : folder_(std::move(folder)), name_(std::move(name)), extension_(std::move(extension)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error)
    throw Stop(ExitCode::out_of_resources, fmt::format("cannot create folder {}: {}", folder_, error.message()));
}

void PvdSeries::add(double time, const std::string& piece_text) {
  write_atomically(fmt::format("{}/{}_{:04}.{}", folder_, name_, times_.size(), extension_), piece_text);
  times_.push_back(time);
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (std::size_t i = 0; i < times_.size(); ++i)
    text += fmt::format("<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}_{:04}.{}\"/>\n", times_[i], name_, i,
                        extension_);
  write_atomically(fmt::format("{}/{}.pvd", folder_, name_), text + "</Collection>\n</VTKFile>\n");
}

}  // namespace standoff
