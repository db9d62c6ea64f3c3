#include "output/xdmf.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mudlark {
namespace {

constexpr std::array<const char*, 6> tensor_components{"xx", "yy", "zz", "xy", "yz", "zx"};

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string label(const std::string& name, const std::string& unit) {
  return unit.empty() || unit == "1" ? escaped(name)
                                     : fmt::format("{} [{}]", escaped(name), escaped(unit));
}

/// `extent`: of the dataset without its components, slowest axis first, as text.
std::string data_item(const std::string& file, const StoredOutput& output, const StoredArray& array,
                      const std::string& extent) {
  return fmt::format(
      "<DataItem Dimensions=\"{}{}\" NumberType=\"{}\" Precision=\"8\" "
      "Format=\"HDF\">{}:{}/{}</DataItem>",
      extent, array.components > 1 ? fmt::format(" {}", array.components) : "",
      array.integers ? "Int" : "Float", file, output.group, escaped(array.dataset));
}

/// One component of a tensor of points: XDMF orders symmetric tensors otherwise than VTK, so each
/// component is shown as a scalar of its own, cut out of the rows.
std::string tensor_component(const std::string& file, const StoredOutput& output,
                             const StoredArray& array, int component) {
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}\"><DataItem Dimensions=\"3 2\" "
      "Format=\"XML\">0 {1} 1 1 {0} "
      "1</DataItem>{2}</DataItem>",
      output.count, component, data_item(file, output, array, fmt::format("{}", output.count)));
}

std::string attribute(const std::string& name, const char* type, const char* centre,
                      const std::string& item) {
  return fmt::format(
      "      <Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"{}\">{}</Attribute>\n", name,
      type, centre, item);
}

std::string document(const std::string& name, const std::string& grids) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"2.0\">\n <Domain>\n"
      "  <Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n{}  </Grid>\n "
      "</Domain>\n</Xdmf>\n",
      name, grids);
}

std::string head(const StoredOutput& output, const char* name) {
  return fmt::format(
      "    <Grid Name=\"{}\" GridType=\"Uniform\">\n      <Time Value=\"{:.17g}\"/>\n", name,
      output.time);
}

}  // namespace

namespace {

std::string uniform_geometry(const XdmfGrid& grid) {
  const auto& [lower, spacing, cells, faces] = grid;
  return fmt::format(
      "      <Topology TopologyType=\"3DCoRectMesh\" Dimensions=\"{} {} {}\"/>\n"
      "      <Geometry GeometryType=\"ORIGIN_DXDYDZ\"><DataItem Dimensions=\"3\" "
      "NumberType=\"Float\" Precision=\"8\" "
      "Format=\"XML\">{:.17g} {:.17g} {:.17g}"
      "</DataItem><DataItem Dimensions=\"3\" NumberType=\"Float\" Precision=\"8\" "
      "Format=\"XML\">{:.17g} {:.17g} "
      "{:.17g}</DataItem></Geometry>\n",
      cells[2] + 1, cells[1] + 1, cells[0] + 1, lower[2], lower[1], lower[0], spacing[2],
      spacing[1], spacing[0]);
}

/// With the positions of all faces along each axis.
std::string stretched_geometry(const XdmfGrid& grid) {
  std::string text = fmt::format(
      "      <Topology TopologyType=\"3DRectMesh\" Dimensions=\"{} {} {}\"/>\n"
      "      <Geometry GeometryType=\"VXVYVZ\">",
      grid.cells[2] + 1, grid.cells[1] + 1, grid.cells[0] + 1);
  for (std::size_t a = 0; a < 3; ++a) {
    text += fmt::format(
        "<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"XML\">",
        grid.cells[a] + 1);
    for (int i = 0; i <= grid.cells[a]; ++i)
      text += fmt::format("{:.17g} ", grid.faces[a].empty()
                                          ? grid.lower[a] + i * grid.spacing[a]
                                          : grid.faces[a][static_cast<std::size_t>(i)]);
    text += "</DataItem>";
  }
  return text + "</Geometry>\n";
}

}  // namespace

std::string xdmf_of_fields(const std::string& data_file, const XdmfGrid& grid,
                           const std::vector<StoredOutput>& outputs) {
  const auto& cells = grid.cells;
  const std::string extent = fmt::format("{} {} {}", cells[2], cells[1], cells[0]);
  const bool stretched = std::any_of(grid.faces.begin(), grid.faces.end(),
                                     [](const auto& faces) { return !faces.empty(); });
  const std::string geometry = stretched ? stretched_geometry(grid) : uniform_geometry(grid);
  std::string grids;
  for (const StoredOutput& output : outputs) {
    grids += head(output, "grid") + geometry;
    for (const StoredArray& array : output.arrays)
      grids += attribute(label(array.name, array.unit), array.components == 3 ? "Vector" : "Scalar",
                         "Cell", data_item(data_file, output, array, extent));
    grids += "    </Grid>\n";
  }
  return document("fields", grids);
}

std::string xdmf_of_points(const std::string& data_file, const std::vector<StoredOutput>& outputs) {
  std::string grids;
  for (const StoredOutput& output : outputs) {
    const std::string rows = fmt::format("{}", output.count);
    std::string geometry, attributes;
    for (const StoredArray& array : output.arrays) {
      const std::string name = label(array.name, array.unit);
      if (array.name == "position")
        geometry = fmt::format("      <Geometry GeometryType=\"XYZ\">{}</Geometry>\n",
                               data_item(data_file, output, array, rows));
      else if (array.components == 6)
        for (int c = 0; c < 6; ++c)
          attributes += attribute(label(fmt::format("{} {}", array.name,
                                                    tensor_components[static_cast<std::size_t>(c)]),
                                        array.unit),
                                  "Scalar", "Node", tensor_component(data_file, output, array, c));
      else if (array.components == 1 || array.components == 3)
        attributes += attribute(name, array.components == 3 ? "Vector" : "Scalar", "Node",
                                data_item(data_file, output, array, rows));
    }
    grids += head(output, "points") +
             fmt::format(
                 "      <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\" "
                 "NodesPerElement=\"1\"/>\n",
                 output.count) +
             geometry + attributes + "    </Grid>\n";
  }
  return document("points", grids);
}

}  // namespace mudlark
