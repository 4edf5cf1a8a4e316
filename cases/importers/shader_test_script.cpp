#include "cases/importers/shader_test_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>

#include "cases/json.h"

namespace rastercheck::cases::shader_test_importer {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::string_view kBlank = " \t\r\f\v";
/// The runner's window, unless SIZE says otherwise.
constexpr int kWindowSize = 250;

std::string_view stripped(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

Words words_of(std::string_view text) {
  Words words;
  while (true) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) return words;
    text.remove_prefix(first);
    const std::size_t end = std::min(text.find_first_of(kBlank), text.size());
    words.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

template <typename T>
std::optional<T> whole(std::string_view text, int base = 10) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// A number as the runner reads it: the bits of a float32 after 0x, else the float32 next to the
/// double next to the decimals.
std::optional<float> number(std::string_view text) {
  if (text.starts_with("0x")) {
    const auto bits = whole<std::uint32_t>(text.substr(2), 16);
    return bits ? std::optional(std::bit_cast<float>(*bits)) : std::nullopt;
  }
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  constexpr auto kInfinity = std::numeric_limits<float>::infinity();
  // Half a step beyond the greatest float32, from where on numbers are rounded to infinity.
  constexpr double kBeyond = 0x1.ffffffp+127;
  if (std::fabs(value) >= kBeyond) return value < 0 ? -kInfinity : kInfinity;
  return static_cast<float>(value);
}

/// That many numbers from a place on.
std::optional<std::vector<float>> numbers(const Words& words, std::size_t from, std::size_t count) {
  if (words.size() < from + count) return std::nullopt;
  std::vector<float> read;
  for (std::size_t i = from; i < from + count; ++i) {
    const std::optional<float> one = number(words[i]);
    if (!one) return std::nullopt;
    read.push_back(*one);
  }
  return read;
}

bool are_finite(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); });
}

tl::unexpected<Refusal> refusal(std::size_t line, std::string reason) {
  return tl::unexpected(Refusal{line, std::move(reason)});
}

/// The number of components of a column's type: "3", "vec3", or a column of "mat2x3".
std::optional<std::size_t> column_size(std::string_view type) {
  for (const std::string_view word : {"double", "float", "int", "uint", "int64_t", "uint64_t"}) {
    if (type == word) return 1;
  }
  if (type.empty() || type.back() < '1' || type.back() > '4') return std::nullopt;
  const bool is_known = type.size() == 1 || type.find("vec") != std::string_view::npos ||
                        type.find("mat") != std::string_view::npos;
  return is_known ? std::optional(static_cast<std::size_t>(type.back() - '0')) : std::nullopt;
}

/// Reads "name/float/3", "name/float/vec3" or, for a column of a matrix, "name/double/dmat2x3/1".
Expected<Column> read_column(std::string_view text, std::size_t line) {
  const std::size_t first = text.find('/');
  const std::size_t second = first == std::string_view::npos ? first : text.find('/', first + 1);
  if (second == std::string_view::npos) {
    return refusal(line,
                   fmt::format("'{}' is no column such as vertex/float/vec3", printable(text)));
  }
  const std::string_view type = text.substr(first + 1, second - first - 1);
  const std::string_view rest = text.substr(second + 1);
  const std::string_view size = rest.substr(0, rest.find('/'));
  const auto count = column_size(size);
  if (!count) return refusal(line, fmt::format("'{}' has no size", printable(text)));
  // What follows a vector's size is a divisor of instances, and a matrix is no float.
  const bool is_plain = size.size() == rest.size() && size.find("mat") == std::string_view::npos;
  return Column{std::string(text.substr(0, first)), type == "float" && is_plain, *count};
}

Expected<VertexData> read_vertex_data(const std::vector<SourceLine>& lines) {
  VertexData data;
  for (const SourceLine& line : lines) {
    const Words words = words_of(line.text.substr(0, line.text.find('#')));
    if (words.empty()) continue;
    if (data.columns.empty()) {
      for (const std::string_view word : words) {
        const Expected<Column> column = read_column(word, line.number);
        if (!column) return tl::unexpected(column.error());
        data.columns.push_back(*column);
      }
      continue;
    }
    std::vector<float> row;
    std::size_t at = 0;
    for (const Column& column : data.columns) {
      for (std::size_t i = 0; i < column.count; ++i, ++at) {
        if (at == words.size()) {
          return refusal(line.number, fmt::format("has {} numbers, too few for the columns", at));
        }
        const std::optional<float> read = column.is_float ? number(words[at]) : 0.0F;
        if (!read) {
          return refusal(line.number, fmt::format("'{}' is no number", printable(words[at])));
        }
        row.push_back(*read);
      }
    }
    data.rows.push_back(std::move(row));
  }
  return data;
}

/// Commands that leave alone what is drawn, but for its colours.
bool is_about_colours(const Words& words) {
  constexpr auto kWords = std::to_array<std::string_view>(
      {"active",  "atomic",     "blend",    "blit",         "color",      "compute",   "fbfetch",
       "hint",    "image",      "link",     "memory",       "parameter",  "patch",     "resident",
       "ssbo",    "subuniform", "texcoord", "texparameter", "texture",    "tolerance", "ubo",
       "uniform", "verify",     "vertex",   "program",      "clearcolor", "block",     "xfb"});
  return std::find(kWords.begin(), kWords.end(), words[0]) != kWords.end();
}

Shape shape_of(std::string_view mode) {
  static const std::map<std::string_view, Shape> kShapes{
      {"GL_TRIANGLES", Shape::triangles},   {"GL_TRIANGLE_STRIP", Shape::strip},
      {"GL_TRIANGLE_FAN", Shape::fan},      {"GL_QUADS", Shape::quads},
      {"GL_QUAD_STRIP", Shape::quad_strip}, {"GL_POLYGON", Shape::polygon}};
  const auto found = kShapes.find(mode);
  return found == kShapes.end() ? Shape::other : found->second;
}

/// The matrices of glOrtho and glFrustum (OpenGL 4.6 compatibility profile, section 12.1.1), row by
/// row, of left, right, bottom, top, near and far.
std::array<double, 16> ortho_matrix(const std::vector<float>& n) {
  const double width = double{n[1]} - n[0];
  const double height = double{n[3]} - n[2];
  const double depth = double{n[5]} - n[4];
  return {2 / width, 0,          0,          -(double{n[1]} + n[0]) / width,   //
          0,         2 / height, 0,          -(double{n[3]} + n[2]) / height,  //
          0,         0,          -2 / depth, -(double{n[5]} + n[4]) / depth,   //
          0,         0,          0,          1};
}
std::array<double, 16> frustum_matrix(const std::vector<float>& n) {
  const double width = double{n[1]} - n[0];
  const double height = double{n[3]} - n[2];
  const double depth = double{n[5]} - n[4];
  const double near = n[4];
  return {2 * near / width,
          0,
          (double{n[1]} + n[0]) / width,
          0,  //
          0,
          2 * near / height,
          (double{n[3]} + n[2]) / height,
          0,  //
          0,
          0,
          -(n[5] + near) / depth,
          -2 * near * n[5] / depth,  //
          0,
          0,
          -1,
          0};
}

/// Follows the commands of [test].
class Commands {
 public:
  Commands(FramebufferSize window, bool has_depth_buffer, Script& script)
      : window_(window), has_depth_buffer_(has_depth_buffer), script_(&script) {
    state_.framebuffer = window;
    state_.viewport.width = static_cast<float>(window.width);
    state_.viewport.height = static_cast<float>(window.height);
  }

  std::optional<Refusal> read(const SourceLine& line) {
    const std::string_view text = stripped(line.text);
    if (text.empty() || text.front() == '#') return std::nullopt;
    const Words words = words_of(text);
    bool is_understood = true;
    if (words[0] == "probe" || words[0] == "relative") {
      ++script_->probes;
    } else if (words[0] == "clear") {
      is_understood = clear(words);
    } else if (words[0] == "draw") {
      is_understood = draw(words, line.number);
    } else if (words[0] == "enable" || words[0] == "disable") {
      is_understood = enable(words);
    } else if (words[0] == "fb") {
      is_understood = framebuffer(words);
    } else if (words[0] == "ortho" || words[0] == "frustum") {
      is_understood = projection(words);
    } else if (words[0] == "clip" || words[0] == "viewport") {
      is_understood = words[0] == "clip" ? plane(words) : viewport(words);
    } else if (words[0] == "depthfunc" && words.size() == 2) {
      depth_function_ = words[1];
    } else if (words[0] == "provoking" && words.size() == 3) {
      state_.is_first_provoking = words[2] == "first";
    } else if (words[0] == "shade" && words.size() == 3) {
      state_.is_flat = words[2] == "flat";
    } else if (words[0] == "polygon" && words.size() == 4) {
      polygon_mode_ = words[3] == "GL_FILL" ? "" : std::string(words[3]);
    } else {
      is_understood = is_about_colours(words);
    }
    if (is_understood) return std::nullopt;
    return Refusal{line.number, fmt::format("'{}' is not understood", printable(text))};
  }

 private:
  bool clear(const Words& words) {
    if (words.size() > 1 && words[1] == "depth") {
      const auto depth = numbers(words, 2, 1);
      const bool is_depth = depth && depth->front() >= 0 && depth->front() <= 1;
      if (!is_depth) return false;
      clear_depth_ = depth->front();
    } else if (words.size() == 1) {
      // Without "clear depth", the runner's clear leaves the depth buffer alone.
      if (clear_depth_) depth_ = clear_depth_;
      ++clears_;
    }
    return true;
  }

  bool enable(const Words& words) {
    if (words.size() < 2) return false;
    const bool is_on = words[0] == "enable";
    const std::string_view what = words[1];
    constexpr std::string_view kPlane = "GL_CLIP_PLANE";
    if (what.starts_with(kPlane)) {
      const auto i = whole<int>(what.substr(kPlane.size()));
      if (!i || *i < 0 || *i >= kPlanes) return false;
      state_.enabled.at(static_cast<std::size_t>(*i)) = is_on;
    } else if (what == "GL_DEPTH_TEST") {
      is_depth_tested_ = is_on;
    } else if (what == "GL_DEPTH_CLAMP") {
      state_.has_depth_clamp = is_on;
    } else if (what == "GL_VERTEX_PROGRAM_TWO_SIDE") {
      state_.is_two_sided = is_on;
    } else if (what != "GL_PROGRAM_POINT_SIZE" && what != "GL_BLEND") {
      return false;
    }
    return true;
  }

  /// "fb ms FORMAT w h samples"; textures are no part of a case.
  bool framebuffer(const Words& words) {
    std::size_t at = 1;
    if (words.size() > at && words[at] == "read") return true;
    if (words.size() > at && words[at] == "draw") ++at;
    if (words.size() <= at) return false;
    framebuffer_reason_.clear();
    is_window_ = words[at] == "winsys";
    if (is_window_) {
      state_.framebuffer = window_;
    } else if (words[at] == "ms" && words.size() == at + 5) {
      const auto width = whole<int>(words[at + 2]);
      const auto height = whole<int>(words[at + 3]);
      const auto samples = whole<int>(words[at + 4]);
      if (!width || !height || !samples) return false;
      if (*width < 1 || *width > kMaxSize || *height < 1 || *height > kMaxSize) return false;
      if (*samples < 0 || *samples > 16 || (*samples & (*samples - 1)) != 0) return false;
      state_.framebuffer = {*width, *height, std::max(*samples, 1)};
    } else {
      framebuffer_reason_ =
          fmt::format("draws into a framebuffer of kind '{}'", printable(words[at]));
    }
    return true;
  }

  /// "ortho" is in pixels; the runner has z from −1 to 1.
  bool projection(const Words& words) {
    std::vector<float> n{0,  static_cast<float>(state_.framebuffer.width),
                         0,  static_cast<float>(state_.framebuffer.height),
                         -1, 1};
    const bool is_ortho = words[0] == "ortho";
    if (words.size() > 1) {
      const auto given = numbers(words, 1, is_ortho ? 4 : 6);
      if (!given) return false;
      std::copy(given->begin(), given->end(), n.begin());
    } else if (!is_ortho) {
      return false;
    }
    const bool is_before_the_eye = n[4] > 0 && n[5] > 0;
    if (!is_ortho && !is_before_the_eye) return false;
    const std::array<double, 16> m = is_ortho ? ortho_matrix(n) : frustum_matrix(n);
    Matrix4 matrix{};
    state_.is_projection_rounded = false;
    for (std::size_t i = 0; i < m.size(); ++i) {
      if (!(std::fabs(m.at(i)) <= double{std::numeric_limits<float>::max()})) return false;
      matrix.at(i) = static_cast<float>(m.at(i));
      // A quotient that a double had to round is no float32 either, but for rare ones.
      if (double{matrix.at(i)} != m.at(i)) state_.is_projection_rounded = true;
    }
    state_.projection = matrix;
    return true;
  }

  bool plane(const Words& words) {
    const auto read = numbers(words, 3, 4);
    if (!read || !are_finite(*read) || words[1] != "plane") return false;
    const auto i = whole<int>(words[2]);
    if (!i || *i < 0 || *i >= kPlanes) return false;
    std::copy(read->begin(), read->end(), state_.planes.at(static_cast<std::size_t>(*i)).begin());
    return true;
  }

  /// "viewport indexed i x y width height", of which the first one is drawn in.
  bool viewport(const Words& words) {
    if (words.size() < 3 || words[1] != "indexed") return false;
    if (words[2] != "0") return true;
    const auto read = numbers(words, 3, 4);
    if (!read || !are_finite(*read)) return false;
    const auto limit = static_cast<float>(kMaxSize);
    const auto& n = *read;
    if (std::fabs(n[0]) > limit || std::fabs(n[1]) > limit) return false;
    const bool has_size = n[2] >= 0 && n[2] <= limit && n[3] >= 0 && n[3] <= limit;
    if (!has_size) return false;
    state_.viewport = {n[0], n[1], n[2], n[3], 0, 1};
    return true;
  }

  bool draw(const Words& words, std::size_t line) {
    DrawCommand command;
    command.line = line;
    command.state = present_state();
    const bool is_instanced =
        words.size() > 2 && (words[1] == "instanced" || words[2] == "instanced");
    if (is_instanced || (words.size() > 1 && words[1] != "arrays" && words[1] != "rect")) {
      command.mode = is_instanced ? "instances" : std::string(words[1]);
    } else if (words.size() == 5 && words[1] == "arrays") {
      const auto first = whole<std::uint32_t>(words[3]);
      const auto count = whole<std::uint32_t>(words[4]);
      if (!first || !count) return false;
      command.mode = words[2];
      command.shape = shape_of(words[2]);
      command.first = *first;
      command.count = *count;
    } else if (words.size() < 6 || !rectangle(words, command)) {
      return false;
    }
    script_->draws.push_back(std::move(command));
    return true;
  }

  /// "draw rect [ortho|tex] x y w h …"; ortho counts in pixels of the window.
  bool rectangle(const Words& words, DrawCommand& command) const {
    const bool is_ortho = words[2] == "ortho";
    const bool is_textured = words[2] == "tex";
    command.mode = words[2] == "patch" || words[3] == "patch" ? "patches" : "rect";
    if (command.mode == "patches") return true;
    const auto n = numbers(words, is_ortho || is_textured ? 3 : 2, is_textured ? 8 : 4);
    if (!n) return false;
    command.shape = Shape::rectangle;
    std::copy_n(n->begin(), 4, command.rectangle.begin());
    if (is_textured) {
      command.textured.emplace();
      std::copy_n(n->begin() + 4, 4, command.textured->begin());
    }
    // In the order and the precisions of the runner, so that the vertices have its bits.
    for (std::size_t i = 0; is_ortho && i < 4; ++i) {
      const int size = i % 2 == 0 ? window_.width : window_.height;
      const double part = 2.0 * double{(*n)[i] / static_cast<float>(size)};
      command.rectangle.at(i) = static_cast<float>(i < 2 ? -1.0 + part : part);
    }
    return true;
  }

  DrawState present_state() const {
    DrawState state = state_;
    // Only the window may have a depth buffer.
    state.has_depth_test = is_depth_tested_ && is_window_ && has_depth_buffer_;
    if (state.has_depth_test) {
      state.depth = depth_;
      state.clears = clears_;
    }
    state.is_depth_test_void = is_depth_tested_ && !state.has_depth_test;
    state.unsayable = framebuffer_reason_;
    if (!polygon_mode_.empty()) {
      state.unsayable = fmt::format("the polygon mode is {}", printable(polygon_mode_));
    } else if (state.has_depth_test && depth_function_ != "GL_LESS") {
      state.unsayable = fmt::format("the depth function is {}", printable(depth_function_));
    }
    return state;
  }

  FramebufferSize window_;
  bool has_depth_buffer_;
  Script* script_;
  DrawState state_;
  bool is_window_ = true;
  bool is_depth_tested_ = false;
  std::string depth_function_ = "GL_LESS";
  std::string polygon_mode_;  ///< empty for GL_FILL
  std::string framebuffer_reason_;
  std::optional<float> clear_depth_;
  std::optional<float> depth_;
  std::size_t clears_ = 0;
};

std::string_view section_of(std::string_view line) {
  return line.starts_with('[') ? line.substr(1, std::min(line.find(']'), line.size()) - 1)
                               : std::string_view();
}

std::vector<SourceLine> lines_of(std::string_view text) {
  std::vector<SourceLine> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.push_back({lines.size() + 1, text.substr(0, end)});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

/// The lines of each section, under its name.
using Sections = std::map<std::string_view, std::vector<SourceLine>>;

Expected<Sections> sections_of(std::string_view text) {
  constexpr auto kKnown = std::to_array<std::string_view>(
      {"require", "vertex shader", "vertex shader passthrough", "fragment shader",
       "fragment program", "vertex data", "test"});
  Sections sections;
  std::vector<SourceLine>* present = nullptr;
  for (const SourceLine& line : lines_of(text)) {
    if (!line.text.starts_with('[')) {
      if (present != nullptr) present->push_back(line);
      continue;
    }
    const std::string_view name = section_of(line.text);
    const bool is_known = std::find(kKnown.begin(), kKnown.end(), name) != kKnown.end();
    if (!is_known || sections.contains(name)) {
      return refusal(line.number, fmt::format("the section [{}] {}", printable(name),
                                              is_known ? "occurs twice" : "is no part of a case"));
    }
    present = &sections[name];
    present->push_back({line.number, ""});
  }
  return sections;
}

/// The shader that the runner takes for [vertex shader passthrough], and the fixed function if
/// there is none.
std::string_view own_shader(bool is_passthrough) {
  return is_passthrough ? "in vec4 piglit_vertex; void main() { gl_Position = piglit_vertex; }"
                        : "void main() { gl_Position = ftransform(); "
                          "gl_TexCoord[0] = gl_MultiTexCoord0; }";
}

}  // namespace

bool begins_like_a_test(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = stripped(text.substr(0, end));
    if (!line.empty() && line.front() != '#' && !line.starts_with("//")) {
      const std::string_view name = section_of(line);
      return name == "require" || name == "test" || name.starts_with("vertex shader") ||
             name == "fragment shader";
    }
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return false;
}

Expected<Script> read_script(std::string_view text) {
  Expected<Sections> read = sections_of(text);
  if (!read) return tl::unexpected(read.error());
  Sections& sections = *read;
  Script script;
  FramebufferSize window{kWindowSize, kWindowSize, 1};
  bool has_depth_buffer = false;
  for (const SourceLine& line : sections["require"]) {
    const Words words = words_of(line.text);
    if (!words.empty() && words[0] == "depthbuffer") has_depth_buffer = true;
    if (words.empty() || words[0] != "SIZE") continue;
    const auto width = words.size() == 3 ? whole<int>(words[1]) : std::nullopt;
    const auto height = words.size() == 3 ? whole<int>(words[2]) : std::nullopt;
    if (!width || !height || *width < 1 || *height < 1 || *width > kMaxSize || *height > kMaxSize) {
      return refusal(line.number,
                     fmt::format("SIZE must have a width and a height up to {}", kMaxSize));
    }
    window = {*width, *height, 1};
  }
  script.vertex_shader = sections["vertex shader"];
  if (script.vertex_shader.empty()) {
    const auto& passthrough = sections["vertex shader passthrough"];
    script.vertex_shader = {
        {passthrough.empty() ? 1 : passthrough.front().number, own_shader(!passthrough.empty())}};
  }
  script.fragment_shader = sections["fragment shader"];
  if (!sections["vertex data"].empty()) {
    Expected<VertexData> data = read_vertex_data(sections["vertex data"]);
    if (!data) return tl::unexpected(data.error());
    script.data = *std::move(data);
  }
  Commands commands(window, has_depth_buffer, script);
  if (sections["test"].empty()) return refusal(1, "has no section [test]");
  script.test_line = sections["test"].front().number;
  for (const SourceLine& line : sections["test"]) {
    if (const std::optional<Refusal> bad = commands.read(line)) return tl::unexpected(*bad);
  }
  return script;
}

}  // namespace rastercheck::cases::shader_test_importer
