// renderdoc-csv: vertices that RenderDoc's mesh viewer exported, from the tab "VS Out" or "GS/DS
// Out". One line for each index of a draw:
//
//   VTX, IDX, gl_Position.x, gl_Position.y, gl_Position.z, gl_Position.w, uv.x, uv.y
//   0, 4, -1.00, 0.50, 0.25, 1.00, 0.00, 1.00
//
// Versions of 2015 write "Vertex,Index,gl_Position 0,gl_Position 1". A vertex that the draw did not
// have reads "---", and a restart index "Restart". Numbers have as many digits as the viewer was
// set to show, so vertices are near those of the draw, not equal to them.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "cases/importer.h"
#include "cases/json.h"

namespace rastercheck::cases::renderdoc_csv_importer {
namespace {

using Cells = std::vector<std::string_view>;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\"";
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

Cells cells_of(std::string_view line) {
  Cells cells;
  while (true) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

std::string lower(std::string_view text) {
  std::string all(text);
  std::transform(all.begin(), all.end(), all.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return all;
}

/// A column's variable, and which of its components the column has.
struct ColumnName {
  std::string_view variable;
  int component = 0;
};

/// Reads "uv.y" as component 1 of uv, and so "uv 1". A name without a component is a scalar's.
ColumnName column_name(std::string_view name) {
  if (name.size() < 3) return {name};
  const char separator = name[name.size() - 2];
  const std::size_t component =
      std::string_view(separator == '.' ? "xyzw" : "0123").find(name.back());
  if ((separator != '.' && separator != ' ') || component == std::string_view::npos) return {name};
  return {name.substr(0, name.size() - 2), static_cast<int>(component)};
}

/// The columns of a table, by what they are.
struct Columns {
  std::array<std::optional<std::size_t>, 4> position;
  std::vector<std::size_t> distances;
  std::vector<std::size_t> attributes;
  std::size_t count = 0;
  bool is_hlsl = false;
};

Columns columns_of(const Cells& header) {
  Columns columns;
  columns.count = header.size();
  for (std::size_t i = 2; i < header.size(); ++i) {
    const ColumnName name = column_name(header[i]);
    const std::string variable = lower(name.variable);
    const bool is_hlsl = variable == "sv_position";
    if (is_hlsl || variable == "gl_position" || variable.ends_with(".gl_position")) {
      columns.position.at(static_cast<std::size_t>(name.component)) = i;
      columns.is_hlsl = is_hlsl;
    } else if (variable.find("gl_clipdistance") != std::string::npos ||
               variable.starts_with("sv_clipdistance")) {
      columns.distances.push_back(i);
    } else if (variable.find("gl_pointsize") == std::string::npos &&
               variable.find("gl_culldistance") == std::string::npos &&
               !variable.starts_with("sv_")) {
      columns.attributes.push_back(i);
    }
  }
  return columns;
}

/// One line of the table: a vertex, or the end of a strip.
struct Row {
  std::vector<float> numbers;  ///< [column]; NaN where the line has no number
  std::string_view index;
  bool is_restart = false;
};

/// The nearest float32; infinity and 0 beyond its range. Empty if the text is no number.
std::optional<float> nearest_float(std::string_view text) {
  if (text == "---") return std::numeric_limits<float>::quiet_NaN();
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto read = [text](auto& value) {
    return std::from_chars(text.begin(), text.end(), value);
  };
  float value = 0;
  const auto [end, error] = read(value);
  if (end != text.data() + text.size() || text.empty()) return std::nullopt;
  if (error == std::errc()) return value;
  if (error != std::errc::result_out_of_range) return std::nullopt;
  double wide = 0;
  const bool is_tiny = read(wide).ec == std::errc() ? std::fabs(wide) < 1
                                                    : text.find("e-") != std::string_view::npos ||
                                                          text.find("E-") != std::string_view::npos;
  const float magnitude = is_tiny ? 0 : std::numeric_limits<float>::infinity();
  return text.starts_with('-') ? -magnitude : magnitude;
}

class Table {
 public:
  Table(std::string_view text, const std::string& file) : rest_(text), file_(&file) {}

  /// The next line that is not blank; empty at the end.
  std::optional<std::string_view> next_line() {
    while (!rest_.empty()) {
      const std::size_t end = std::min(rest_.find('\n'), rest_.size());
      const std::string_view line = trimmed(rest_.substr(0, end));
      rest_.remove_prefix(std::min(end + 1, rest_.size()));
      ++line_;
      if (!line.empty()) return line;
    }
    return std::nullopt;
  }

  tl::unexpected<Error> refusal(std::size_t column, const std::string& reason) const {
    return tl::unexpected(
        Error{*file_, fmt::format("line {}, column {}", line_, column + 1), reason});
  }

  Result<Row> row(std::string_view line, const Columns& columns) const {
    const Cells cells = cells_of(line);
    Row row;
    row.is_restart = lower(line).find("restart") != std::string::npos;
    if (row.is_restart) return row;
    if (cells.size() != columns.count) {
      return refusal(cells.size() - 1, fmt::format("has {} cells where the header has {}",
                                                   cells.size(), columns.count));
    }
    row.index = cells[1];
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<float> number = i < 2 ? 0.0F : nearest_float(cells[i]);
      if (!number) return refusal(i, fmt::format("'{}' is no number", printable(cells[i])));
      row.numbers.push_back(*number);
    }
    return row;
  }

 private:
  std::string_view rest_;
  const std::string* file_;
  std::size_t line_ = 0;
};

/// Vertices and triangles while rows come in.
struct Gathered {
  std::vector<std::vector<float>> vertices;        ///< [vertex][column]
  std::vector<std::vector<std::uint32_t>> strips;  ///< vertices between restarts, in order
  std::map<std::string_view, std::uint32_t> by_index;

  void add(Row row) {
    if (row.is_restart) {
      strips.emplace_back();
      return;
    }
    // NaN is unequal to itself, and such a vertex is never shared.
    const auto known = by_index.find(row.index);
    if (known != by_index.end() && vertices[known->second] == row.numbers) {
      strips.back().push_back(known->second);
      return;
    }
    const auto next = static_cast<std::uint32_t>(vertices.size());
    by_index[row.index] = next;
    strips.back().push_back(next);
    vertices.push_back(std::move(row.numbers));
  }

  std::size_t row_count() const {
    std::size_t count = 0;
    for (const auto& strip : strips) count += strip.size();
    return count;
  }
};

/// Makes the case of a table, and the notes about it.
class Maker {
 public:
  Maker(const Columns& columns, const Cells& header, const Gathered& gathered,
        const ImportOptions& options)
      : columns_(&columns), header_(&header), gathered_(&gathered), options_(&options) {}

  Imported make(const std::string& file) {
    choose_rules();
    c_.fill_rule = default_fill_rule(c_.rules);
    c_.basis = default_basis(c_.rules);
    c_.cull = options_->cull.value_or(Cull::none);
    c_.front_face = options_->front_face.value_or(FrontFace::ccw);
    choose_size();
    c_.name = fmt::format("{}, from decimals",
                          printable(std::filesystem::path(file).filename().string()));
    add_triangles();
    choose_columns();
    add_vertices();
    return {std::move(c_), std::move(notes_)};
  }

 private:
  template <typename... Arguments>
  void note(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    notes_.push_back(fmt::format(form, std::forward<Arguments>(arguments)...));
  }

  float number(std::uint32_t vertex, std::size_t column) const {
    return gathered_->vertices[vertex][column];
  }
  float coordinate(std::uint32_t vertex, std::size_t axis) const {
    const auto column = columns_->position.at(axis);
    if (column) return number(vertex, *column);
    return axis == 3 ? 1.0F : 0.0F;
  }
  bool is_placed(std::uint32_t vertex) const {
    for (std::size_t axis = 0; axis < 4; ++axis) {
      if (!std::isfinite(coordinate(vertex, axis))) return false;
    }
    return true;
  }

  /// Only OpenGL draws what lies at −w <= z < 0.
  bool has_vertices_for_opengl_only() const {
    for (std::uint32_t i = 0; i < gathered_->vertices.size(); ++i) {
      const float w = coordinate(i, 3);
      const auto is_inside = [&](std::size_t axis) { return std::fabs(coordinate(i, axis)) <= w; };
      if (w > 0 && coordinate(i, 2) < 0 && is_inside(0) && is_inside(1) && is_inside(2))
        return true;
    }
    return false;
  }

  void choose_rules() {
    if (options_->rules) {
      c_.rules = *options_->rules;
    } else if (columns_->is_hlsl) {
      c_.rules = Rules::d3d;
      note("rules of d3d, because positions are called SV_Position (--rules)");
    } else if (has_vertices_for_opengl_only()) {
      c_.rules = Rules::opengl;
      note(
          "rules of opengl, because a vertex that is inside otherwise has z between -w and 0 "
          "(--rules)");
    } else {
      c_.rules = Rules::vulkan;
      note("rules of vulkan (--rules)");
    }
  }

  void choose_size() {
    constexpr int kUsual = 512;
    c_.framebuffer.width = options_->width.value_or(kUsual);
    c_.framebuffer.height = options_->height.value_or(options_->width ? *options_->width : kUsual);
    c_.framebuffer.samples = options_->samples.value_or(1);
    c_.viewport.width = static_cast<float>(c_.framebuffer.width);
    c_.viewport.height = static_cast<float>(c_.framebuffer.height);
    if (options_->viewport) {
      const auto& [x, y, width, height] = *options_->viewport;
      c_.viewport = {x, y, width, height};
    }
    if (options_->width && options_->height) return;
    note("a framebuffer of {} by {} pixels (--width, --height)", c_.framebuffer.width,
         c_.framebuffer.height);
  }

  Topology topology() {
    if (options_->topology) return *options_->topology;
    const std::size_t rows = gathered_->row_count();
    const bool has_restarts = gathered_->strips.size() > 1;
    if (!has_restarts && rows % 3 == 0) {
      note("a list of triangles, because {} vertices are a multiple of three (--topology)", rows);
      return Topology::triangles;
    }
    note("a strip of triangles, because {} (--topology)",
         has_restarts ? std::string("it has restarts")
                      : fmt::format("{} vertices are no multiple of three", rows));
    return Topology::strip;
  }

  void add_triangles() {
    const Topology by = topology();
    std::size_t lost = 0;
    for (const auto& strip : gathered_->strips) {
      for (Triangle t : triangles_of(by, static_cast<std::uint32_t>(strip.size()), c_.rules)) {
        for (std::uint32_t& corner : t) corner = strip[corner];
        const bool is_drawn =
            std::all_of(t.begin(), t.end(), [this](std::uint32_t i) { return is_placed(i); });
        if (is_drawn) c_.triangles.push_back(t);
        lost += is_drawn ? 0 : 1;
      }
    }
    if (lost > 0) {
      note("{} triangle{} left out: a position is missing, NaN or infinite", lost,
           lost == 1 ? "" : "s");
    }
  }

  bool is_finite_where_drawn(std::size_t column) const {
    return std::all_of(c_.triangles.begin(), c_.triangles.end(), [&](const Triangle& t) {
      return std::all_of(t.begin(), t.end(),
                         [&](std::uint32_t i) { return std::isfinite(number(i, column)); });
    });
  }

  /// Keeps the columns that a case can hold: finite ones, as many as it may have.
  std::vector<std::size_t> held_columns(const std::vector<std::size_t>& all, std::size_t most) {
    std::vector<std::size_t> held;
    std::size_t not_finite = 0;
    std::size_t too_many = 0;
    for (const std::size_t column : all) {
      if (!is_finite_where_drawn(column)) {
        ++not_finite;
      } else if (held.size() == most) {
        ++too_many;
      } else {
        held.push_back(column);
      }
    }
    if (not_finite > 0) {
      note("{} column{} left out: a number is missing, NaN or infinite", not_finite,
           not_finite == 1 ? "" : "s");
    }
    if (too_many > 0) note("{} columns left out: a case has {} at most", too_many, most);
    return held;
  }

  void choose_columns() {
    distances_ = held_columns(columns_->distances, kMaxClipDistances);
    attributes_ = held_columns(columns_->attributes, kMaxAttributes);
    c_.clip_distance_count = distances_.size();
    for (const std::size_t column : attributes_) {
      const std::string name = printable((*header_)[column]);
      c_.attributes.push_back({name, interpolation_of(name), Location::sample});
    }
  }

  /// A variable's name stands for all of its components.
  Interpolation interpolation_of(const std::string& name) const {
    const auto is_among = [&name](const std::vector<std::string>& names) {
      return std::any_of(names.begin(), names.end(), [&name](const std::string& one) {
        return one == name || one == column_name(name).variable;
      });
    };
    if (is_among(options_->flat)) return Interpolation::flat;
    return is_among(options_->noperspective) ? Interpolation::noperspective : Interpolation::smooth;
  }

  /// Adds the vertices that triangles use, and numbers them anew.
  void add_vertices() {
    std::map<std::uint32_t, std::uint32_t> added;
    for (Triangle& triangle : c_.triangles) {
      for (std::uint32_t& corner : triangle) {
        const auto [at, is_new] =
            added.emplace(corner, static_cast<std::uint32_t>(c_.positions.size()));
        if (is_new) add_vertex(corner);
        corner = at->second;
      }
    }
  }

  void add_vertex(std::uint32_t vertex) {
    c_.positions.push_back({coordinate(vertex, 0), coordinate(vertex, 1), coordinate(vertex, 2),
                            coordinate(vertex, 3)});
    for (const std::size_t column : attributes_) {
      c_.attribute_values.push_back(number(vertex, column));
    }
    for (const std::size_t column : distances_) c_.clip_distances.push_back(number(vertex, column));
  }

  const Columns* columns_;
  const Cells* header_;
  const Gathered* gathered_;
  const ImportOptions* options_;
  std::vector<std::size_t> distances_;
  std::vector<std::size_t> attributes_;
  Case c_;
  std::vector<std::string> notes_;
};

bool is_header(const Cells& cells) {
  if (cells.size() < 3) return false;
  const std::string first = lower(cells[0]);
  const std::string second = lower(cells[1]);
  return (first == "vtx" && second == "idx") || (first == "vertex" && second == "index");
}

bool recognises(std::string_view text) {
  return is_header(cells_of(text.substr(0, text.find('\n'))));
}

/// The attributes named by an option must exist.
std::string missing_name(const ImportOptions& options, const Columns& columns,
                         const Cells& header) {
  for (const auto* names : {&options.flat, &options.noperspective}) {
    for (const std::string& name : *names) {
      const bool is_there = std::any_of(
          columns.attributes.begin(), columns.attributes.end(), [&](std::size_t column) {
            return header[column] == name || column_name(header[column]).variable == name;
          });
      if (!is_there) return name;
    }
  }
  return "";
}

Result<Imported> import(std::string_view text, const std::string& file,
                        const ImportOptions& options) {
  Table table(text, file);
  const Cells header = cells_of(table.next_line().value_or(""));
  if (!is_header(header)) {
    return table.refusal(0, "must begin with VTX, IDX or Vertex,Index, as RenderDoc writes it");
  }
  const Columns columns = columns_of(header);
  if (!columns.position[0] || !columns.position[1]) {
    return table.refusal(0,
                         "has no columns gl_Position.x and .y, or SV_Position.x and .y: export the "
                         "tab VS Out or GS/DS Out, which has clip positions");
  }
  if (const std::string name = missing_name(options, columns, header); !name.empty()) {
    return tl::unexpected(Error{file, "", fmt::format("has no column '{}'", printable(name))});
  }
  Gathered gathered;
  gathered.strips.emplace_back();
  while (const auto line = table.next_line()) {
    Result<Row> row = table.row(*line, columns);
    if (!row) return tl::unexpected(row.error());
    gathered.add(*std::move(row));
  }
  Imported imported = Maker(columns, header, gathered, options).make(file);
  if (imported.drawn.triangles.empty()) {
    return tl::unexpected(Error{file, "", "has no triangle that could be drawn"});
  }
  return imported;
}

const ImporterRegistration kRegistration({"renderdoc-csv",
                                          "vertices of one draw that RenderDoc exported as CSV",
                                          &recognises, &import});

}  // namespace
}  // namespace rastercheck::cases::renderdoc_csv_importer
