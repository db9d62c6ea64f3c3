#include "input/height_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "input/text_columns.hpp"

namespace mudlark {
namespace {

constexpr std::size_t most_heights = 100'000'000;

bool is_missing(std::string_view text) { return text.empty() || text == "nan" || text == "NaN"; }

/// Columns in the order of the file, found by the names in a header or by their order.
struct Rows {
  std::array<std::vector<double>, 3> values;
  std::vector<int> lines;
  std::array<std::string, 3> units{};
};

/// `axes`: which of x, y, z the columns are.
Rows read_rows(TextLines& lines, std::string_view first, const std::vector<std::size_t>& axes) {
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  Rows rows;
  std::array<std::size_t, 3> column{};
  for (std::size_t i = 0; i < axes.size(); ++i) column[axes[i]] = i;
  std::string_view text = first;
  auto fields = fields_of(text, separator_of(text));
  bool more = true;
  if (!number_of(fields.front()) && !is_missing(fields.front())) {  // a header
    for (const std::size_t axis : axes) {
      const auto found = std::find_if(fields.begin(), fields.end(), [&](std::string_view title) {
        return name_in(title) == names[axis];
      });
      if (found == fields.end())
        lines.fail(fmt::format("there is no column \"{}\" in this line, the header", names[axis]));
      column[axis] = static_cast<std::size_t>(found - fields.begin());
      rows.units[axis] = unit_in(*found);
    }
    more = lines.next(text);
  }
  for (; more; more = lines.next(text)) {
    fields = fields_of(text, separator_of(text));
    for (const std::size_t axis : axes) {
      if (column[axis] >= fields.size())
        lines.fail(fmt::format("column {} ({}) is missing", column[axis] + 1, names[axis]));
      const std::string_view field = fields[column[axis]];
      const bool missing = axis == 2 && axes.size() == 3 && is_missing(field);
      rows.values[axis].push_back(missing ? std::nan("") : lines.number_in(field));
    }
    rows.lines.push_back(lines.number());
  }
  if (rows.lines.size() < 2) lines.fail_in_file("a ground needs at least two lines of numbers");
  return rows;
}

HeightFile read_line(TextLines& lines, std::string_view first) {
  Rows rows = read_rows(lines, first, {0, 2});
  for (std::size_t i = 1; i < rows.lines.size(); ++i)
    if (!(rows.values[0][i] > rows.values[0][i - 1]))
      lines.fail_at(rows.lines[i],
                    fmt::format("x = {:g} does not lie beyond the one before, {:g}: the line runs "
                                "in the direction of growing x",
                                rows.values[0][i], rows.values[0][i - 1]));
  return {std::move(rows.values[0]), {}, std::move(rows.values[2]), rows.units};
}

/// Values that differ by round-off are one.
std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double hair = 1e-7 * (values.back() - values.front());
  std::vector<double> kept;
  for (const double value : values)
    if (kept.empty() || value > kept.back() + hair) kept.push_back(value);
  return kept;
}
std::size_t index_in(const std::vector<double>& places, double value) {
  const auto after = std::lower_bound(places.begin(), places.end(), value);
  if (after == places.begin()) return 0;
  const auto i = static_cast<std::size_t>(after - places.begin());
  return after == places.end() || value - places[i - 1] < places[i] - value ? i - 1 : i;
}

HeightFile read_lattice(TextLines& lines, std::string_view first) {
  const Rows rows = read_rows(lines, first, {0, 1, 2});
  HeightFile file{distinct(rows.values[0]), distinct(rows.values[1]), {}, rows.units};
  const std::size_t columns = file.x.size(), count = columns * file.y.size();
  if (columns < 2 || file.y.size() < 2)
    lines.fail_in_file("a ground in space needs heights at two places along x and along y");
  if (count > most_heights || count > 4 * rows.lines.size())
    lines.fail_in_file(
        fmt::format("the places are no lattice: {} different x and {} different y, but {} heights",
                    columns, file.y.size(), rows.lines.size()));
  file.heights.assign(count, std::nan(""));
  std::vector<int> seen(count, 0);
  for (std::size_t r = 0; r < rows.lines.size(); ++r) {
    const std::size_t at =
        index_in(file.y, rows.values[1][r]) * columns + index_in(file.x, rows.values[0][r]);
    if (seen[at] > 0)
      lines.fail_at(rows.lines[r],
                    fmt::format("line {} has a height for this place, too", seen[at]));
    seen[at] = rows.lines[r];
    file.heights[at] = rows.values[2][r];
  }
  return file;
}

/// The header of an ESRI ASCII grid: a word and a number per line, in any order, any case.
struct GridHeader {
  double columns = 0.0, rows = 0.0, x = std::nan(""), y = std::nan(""), size = 0.0;
  bool x_of_centre = false, y_of_centre = false;
  double missing = -9999.0;

  /// False when the line does not belong to the header.
  bool take(const TextLines& lines, const std::vector<std::string_view>& words) {
    if (words.size() != 2 || number_of(words[0])) return false;
    std::string key(words[0]);
    std::transform(key.begin(), key.end(), key.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const double value = lines.number_in(words[1]);
    if (key == "ncols")
      columns = value;
    else if (key == "nrows")
      rows = value;
    else if (key == "xllcorner" || key == "xllcenter")
      x = value, x_of_centre = key == "xllcenter";
    else if (key == "yllcorner" || key == "yllcenter")
      y = value, y_of_centre = key == "yllcenter";
    else if (key == "cellsize")
      size = value;
    else if (key == "nodata_value")
      missing = value;
    else
      lines.fail(
          fmt::format("\"{}\" is no word of an ESRI ASCII grid (ncols, nrows, xllcorner or "
                      "xllcenter, yllcorner or yllcenter, cellsize, NODATA_value)",
                      words[0]));
    return true;
  }
  void check(const TextLines& lines) const {
    const auto whole = [](double count) { return count >= 2.0 && count == std::floor(count); };
    if (!whole(columns) || !whole(rows))
      lines.fail("before the heights the header must give ncols and nrows, at least 2");
    if (columns * rows > static_cast<double>(most_heights))
      lines.fail(fmt::format("{:g} heights are more than this program reads", columns * rows));
    if (std::isnan(x) || std::isnan(y) || !(size > 0.0))
      lines.fail(
          "before the heights the header must give xllcorner, yllcorner (or ..center) and "
          "cellsize above 0");
  }
};

/// Rows run from north to south; heights stand in the middle of their cells.
HeightFile read_esri(TextLines& lines, std::string_view text) {
  GridHeader header;
  bool more = true;
  while (more && header.take(lines, fields_of(text, ' '))) more = lines.next(text);
  header.check(lines);
  const auto columns = static_cast<std::size_t>(header.columns);
  const auto rows = static_cast<std::size_t>(header.rows);
  HeightFile file;
  const auto places = [&](double start, bool of_centre, std::size_t count) {
    std::vector<double> all(count);
    for (std::size_t i = 0; i < count; ++i)
      all[i] = start + (static_cast<double>(i) + (of_centre ? 0.0 : 0.5)) * header.size;
    return all;
  };
  file.x = places(header.x, header.x_of_centre, columns);
  file.y = places(header.y, header.y_of_centre, rows);
  file.heights.assign(columns * rows, std::nan(""));
  std::size_t read = 0;
  for (; more; more = lines.next(text))
    for (const std::string_view word : fields_of(text, ' ')) {
      if (read == columns * rows)
        lines.fail(fmt::format("more than {} x {} heights", columns, rows));
      const double value = lines.number_in(word);
      const std::size_t row = rows - 1 - read / columns;
      if (value != header.missing) file.heights[row * columns + read % columns] = value;
      ++read;
    }
  if (read < columns * rows)
    lines.fail(fmt::format("the file ends after {} of {} x {} heights", read, columns, rows));
  return file;
}

}  // namespace

HeightFile read_height_file(const std::filesystem::path& path, bool line) {
  TextLines lines(path);
  std::string_view first;
  if (!lines.next(first)) lines.fail_in_file("it is empty");
  const std::string_view word = fields_of(first, ' ').front();
  const bool esri = word.size() == 5 && (word[0] == 'n' || word[0] == 'N') && !number_of(word) &&
                    (word == "ncols" || word == "NCOLS" || word == "nrows" || word == "NROWS");
  if (line && esri)
    lines.fail("an ESRI ASCII grid is for three dimensions; a line has the columns x and z");
  if (line) return read_line(lines, first);
  return esri ? read_esri(lines, first) : read_lattice(lines, first);
}

}  // namespace mudlark
