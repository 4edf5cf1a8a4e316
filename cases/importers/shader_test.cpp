// shader_test: tests of piglit's shader_runner whose vertex shaders pass through what they are
// given, or compute with it in a line or two. Such a test says all that a case has: vertices as
// the runner reads them, framebuffer, viewport and state. Colours and probes are no part of a case;
// it shows which samples are covered, at what depth, and what the fragment shader's inputs are.
//
// shader_test_script.h reads the commands, shader_test_shader.h the shaders; shader_test_run.h runs
// the vertex shader.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "cases/importer.h"
#include "cases/importers/shader_test_run.h"
#include "cases/importers/shader_test_script.h"
#include "cases/json.h"

namespace rastercheck::cases::shader_test_importer {
namespace {

/// More than any test by hand needs; reading a longer one would take minutes.
constexpr std::size_t kMaxVertices = std::size_t{1} << 20;
constexpr std::size_t kMaxWork = std::size_t{1} << 28;  ///< tokens times names times vertices

/// An output of the vertex shader that the fragment shader reads.
struct Varying {
  std::string variable;  ///< as the vertex shader writes it
  std::string name;      ///< as the fragment shader reads it
  Interpolation interpolation = Interpolation::smooth;
  Location location = Location::sample;
  int components = 0;
  bool is_colour = false;
};

/// A vertex with all of its numbers.
struct Shaded {
  ClipVertex position;
  std::vector<float> attributes;
  std::vector<float> distances;
};

bool is_finite(const ClipVertex& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && std::isfinite(p.w);
}

/// a · b as a double, and whether it or its float32 was rounded.
std::pair<float, bool> dot(const std::array<float, 4>& a, const std::array<float, 4>& b) {
  double sum = 0;
  bool is_rounded = false;
  for (std::size_t i = 0; i < 4; ++i) {
    const double product = double{a.at(i)} * double{b.at(i)};  // exact: 48 bits
    const double next = sum + product;
    // Of an exact sum, either difference gives the other operand back.
    is_rounded = is_rounded || next - sum != product || next - product != sum;
    sum = next;
  }
  const auto nearest = static_cast<float>(sum);
  return {nearest, is_rounded || double{nearest} != sum};
}

/// The triangles of `count` vertices. Flat attributes come from the last vertex of each, whichever
/// the test has chosen. Quads are split as Mesa does, at the diagonal through their provoking
/// vertex.
std::vector<Triangle> triangles_of_shape(Shape shape, std::uint32_t count, bool is_first) {
  std::vector<Triangle> triangles;
  if (shape == Shape::quads || shape == Shape::quad_strip) {
    const std::uint32_t step = shape == Shape::quads ? 4 : 2;
    for (std::uint32_t i = 0; i + 3 < count; i += step) {
      const bool is_strip = shape == Shape::quad_strip;
      const std::uint32_t third = i + (is_strip ? 3 : 2);
      const std::uint32_t fourth = i + (is_strip ? 2 : 3);
      if (is_strip) {
        triangles.push_back({i, i + 1, third});
        triangles.push_back({fourth, i, third});
      } else {
        triangles.push_back({i, i + 1, fourth});
        triangles.push_back({i + 1, third, fourth});
      }
    }
    return triangles;
  }
  if (shape == Shape::polygon) return triangles_of(Topology::fan, count, Rules::vulkan);
  const Topology topology = shape == Shape::triangles ? Topology::triangles
                            : shape == Shape::fan     ? Topology::fan
                                                      : Topology::strip;
  triangles = triangles_of(topology, count, is_first ? Rules::vulkan : Rules::opengl);
  if (is_first) {
    for (Triangle& t : triangles) std::rotate(t.begin(), t.begin() + 1, t.end());
  }
  return triangles;
}

class Maker {
 public:
  Maker(const Script& script, const Shader& vertex, const Shader& fragment)
      : script_(&script), vertex_(&vertex), fragment_(&fragment) {}

  Expected<Imported> make(const std::string& file) {
    if (const auto refused = choose_draws()) return tl::unexpected(*refused);
    set_state(file);
    if (const auto refused = choose_varyings()) return tl::unexpected(*refused);
    for (const DrawCommand* draw : drawn_) {
      if (const auto refused = add(*draw)) return tl::unexpected(*refused);
    }
    if (const auto refused = add_vertices()) return tl::unexpected(*refused);
    add_last_notes();
    return Imported{std::move(c_), std::move(notes_)};
  }

 private:
  using Refused = std::optional<Refusal>;

  template <typename... Arguments>
  void note(fmt::format_string<Arguments...> form, Arguments&&... arguments) {
    notes_.push_back(fmt::format(form, std::forward<Arguments>(arguments)...));
  }
  static Refusal named(const std::string& name, const Refusal& refusal, std::size_t line) {
    return {refusal.line == 0 ? line : refusal.line, fmt::format("{} {}", name, refusal.reason)};
  }
  static const char* plural(std::size_t count) { return count == 1 ? "" : "s"; }

  /// Keeps the draws with the state of the first one that a case can say.
  Refused choose_draws() {
    std::map<std::string, std::pair<std::size_t, std::size_t>> left_out;  // first line, count
    Refusal first{script_->test_line, "draws nothing"};
    std::set<std::tuple<Shape, std::uint32_t, std::uint32_t, std::array<float, 4>,
                        std::optional<std::array<float, 4>>>>
        known;
    std::size_t repeated = 0;
    for (const DrawCommand& draw : script_->draws) {
      std::string why;
      if (draw.shape == Shape::other) {
        why = fmt::format("draws {}; a case has only triangles, each drawn once",
                          printable(draw.mode));
      } else if (!draw.state.unsayable.empty()) {
        why = draw.state.unsayable;
      } else if (!drawn_.empty() && draw.state != drawn_.front()->state) {
        why = "has another state than the first draw";
      }
      if (why.empty()) {
        const bool is_new =
            known.emplace(draw.shape, draw.first, draw.count, draw.rectangle, draw.textured).second;
        repeated += is_new ? 0 : 1;
        if (is_new) drawn_.push_back(&draw);
        continue;
      }
      if (left_out.empty()) first = {draw.line, why};
      ++left_out.try_emplace(why, draw.line, 0).first->second.second;
    }
    if (drawn_.empty()) return first;
    for (const auto& [why, where] : left_out) {
      note("{} draw{} left out, the first in line {}: {}", where.second, plural(where.second),
           where.first, why);
    }
    if (repeated > 0) {
      note("{} draw{} left out: the same vertices are drawn before", repeated, plural(repeated));
    }
    return std::nullopt;
  }

  const DrawState& state() const { return drawn_.front()->state; }

  void set_state(const std::string& file) {
    c_.name = printable(std::filesystem::path(file).filename().string());
    c_.rules = Rules::opengl;
    c_.fill_rule = default_fill_rule(c_.rules);
    c_.basis = default_basis(c_.rules);
    c_.framebuffer = state().framebuffer;
    c_.viewport = state().viewport;
    c_.depth_clamp = state().has_depth_clamp;
    if (state().has_depth_test && state().depth) {
      c_.depth_test = DepthTest::less;
      c_.depth_clear = state().depth;
    } else if (state().has_depth_test) {
      note("no depth test: the test does not clear the depth buffer, whose content is undefined");
    } else if (state().is_depth_test_void) {
      note("no depth test: the framebuffer has no depth buffer");
    }
  }

  /// With several samples, an input without a location may be evaluated anywhere in the pixel.
  Location location(const Global* in, const Global* out, const std::string& name,
                    Interpolation by) {
    if (in != nullptr && in->location) return *in->location;
    if (out != nullptr && out->location) return *out->location;
    if (c_.framebuffer.samples == 1 || by == Interpolation::flat) return Location::sample;
    const auto& tokens = fragment_->tokens;
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
      if (tokens[i].text == "interpolateAtOffset" && tokens[i + 2].text == name)
        return Location::center;
    }
    note("{} is evaluated at the pixel's centre, where OpenGL lets a driver choose",
         printable(name));
    return Location::center;
  }

  void add_varying(const std::string& variable, const std::string& name, const Global* in,
                   const Global* out, int components) {
    const bool is_colour = name == "gl_Color" || name == "gl_SecondaryColor";
    Interpolation by = Interpolation::smooth;
    if (is_colour && state().is_flat) by = Interpolation::flat;
    if (out != nullptr) by = out->interpolation.value_or(by);
    if (in != nullptr) by = in->interpolation.value_or(by);
    varyings_.push_back({variable, name, by, location(in, out, name, by), components, is_colour});
  }

  /// The fragment shader's input that an output goes to.
  const Global* input_of(const Global& out) const {
    for (const Global& in : fragment_->globals) {
      const bool is_same = in.name == out.name || (in.slot && in.slot == out.slot);
      if (in.storage == "in" && is_same && fragment_->mentions(in.name, 2)) return &in;
    }
    return nullptr;
  }

  Refused choose_varyings() {
    for (const Global& out : vertex_->globals) {
      if (out.storage != "out" || out.name.starts_with("gl_")) continue;
      const std::string name(out.name);
      const Global* in = input_of(out);
      const int components = components_of(out.type);
      if (in == nullptr) {
        note("{} left out: the fragment shader does not read it", printable(name));
      } else if (components == 0 || out.is_array) {
        note("{} left out: attributes of a case are float32, and not {}{}", printable(name),
             printable(out.type), out.is_array ? "[]" : "");
      } else {
        add_varying(name, name, in, &out, components);
      }
    }
    for (const auto& [variable, name] : {std::pair("gl_FrontColor", "gl_Color"),
                                         {"gl_FrontSecondaryColor", "gl_SecondaryColor"},
                                         {"gl_FogFragCoord", "gl_FogFragCoord"}}) {
      const Global* in = fragment_->find(name);
      if (!fragment_->mentions(name, in == nullptr ? 1 : 2)) continue;
      if (state().is_two_sided && std::string_view(name) != "gl_FogFragCoord") {
        return Refusal{drawn_.front()->line,
                       fmt::format("{} has another value on back faces", name)};
      }
      const bool is_fog = std::string_view(name) == "gl_FogFragCoord";
      add_varying(variable, name, in, vertex_->find(variable), is_fog ? 1 : 4);
    }
    add_texture_coordinates();
    return std::nullopt;
  }

  void add_texture_coordinates() {
    std::set<std::string> read;
    const auto& tokens = fragment_->tokens;
    for (std::size_t i = 0; i + 2 < tokens.size(); ++i) {
      if (tokens[i].text != "gl_TexCoord" || tokens[i + 1].text != "[") continue;
      const std::optional<int> index = integer(tokens[i + 2].text);
      // The size in a declaration is no index: nothing is assigned there.
      if (index) read.insert(fmt::format("gl_TexCoord[{}]", *index));
      if (!index) note("gl_TexCoord[] left out where its index is no number");
    }
    const Global* in = fragment_->find("gl_TexCoord");
    for (const std::string& name : read) add_varying(name, name, in, nullptr, 4);
  }

  bool has_flat() const {
    return std::any_of(varyings_.begin(), varyings_.end(),
                       [](const Varying& v) { return v.interpolation == Interpolation::flat; });
  }

  Refused add(const DrawCommand& draw) {
    const bool is_first = draw.state.is_first_provoking && has_flat();
    const bool has_quads = draw.shape == Shape::quads || draw.shape == Shape::quad_strip;
    if (is_first && has_quads) {
      return Refusal{draw.line, "draws quads whose first vertex has the flat attributes"};
    }
    std::vector<std::size_t> corners;
    if (draw.shape == Shape::rectangle) {
      if (const auto refused = add_rectangle(draw, corners)) return refused;
    } else if (const auto refused = add_rows(draw, corners)) {
      return refused;
    }
    for (Triangle t :
         triangles_of_shape(draw.shape, static_cast<std::uint32_t>(corners.size()), is_first)) {
      for (std::uint32_t& corner : t) corner = static_cast<std::uint32_t>(corners[corner]);
      const bool is_placed = std::all_of(
          t.begin(), t.end(), [&](std::uint32_t i) { return is_finite(shaded_[i].position); });
      if (is_placed) c_.triangles.push_back(t);
      lost_ += is_placed ? 0 : 1;
    }
    is_turned_ = is_turned_ || is_first;
    is_split_ = is_split_ || has_quads || draw.shape == Shape::polygon;
    return std::nullopt;
  }

  Refused add_rows(const DrawCommand& draw, std::vector<std::size_t>& corners) {
    if (!script_->data) return Refusal{draw.line, "draws arrays, but there is no [vertex data]"};
    const std::size_t rows = script_->data->rows.size();
    if (draw.first > rows || draw.count > rows - draw.first) {
      return Refusal{draw.line, fmt::format("draws beyond the {} rows of [vertex data]", rows)};
    }
    for (std::size_t row = draw.first; row < std::size_t{draw.first} + draw.count; ++row) {
      const auto [known, is_new] = by_row_.try_emplace(row, shaded_.size());
      corners.push_back(known->second);
      if (!is_new) continue;
      Inputs inputs;
      std::size_t at = 0;
      for (const Column& column : script_->data->columns) {
        std::array<float, 4> numbers{0, 0, 0, 1};
        for (std::size_t i = 0; i < column.count; ++i, ++at) {
          numbers.at(i) = script_->data->rows[row][at];
        }
        if (column.is_float) inputs[column.name] = numbers;
      }
      if (const auto refused = shade(inputs, draw)) return refused;
    }
    return check_work(corners.size(), draw);
  }

  /// The vertices of tests/util/piglit-util-gl.c, piglit_draw_rect_custom() and _tex().
  Refused add_rectangle(const DrawCommand& draw, std::vector<std::size_t>& corners) {
    if (script_->data) {
      return Refusal{draw.line, "draws a rectangle while [vertex data] is there as well"};
    }
    const auto& [x, y, width, height] = draw.rectangle;
    const std::array<float, 4> t = draw.textured.value_or(std::array<float, 4>{});
    const bool is_named = vertex_->mentions("piglit_vertex");
    for (int corner = 0; corner < 4; ++corner) {
      const bool is_right = corner % 2 == 1;
      const bool is_top = corner >= 2;
      Inputs inputs;
      inputs[is_named ? "piglit_vertex" : "gl_Vertex"] = {is_right ? x + width : x,
                                                          is_top ? y + height : y, 0, 1};
      const std::array<float, 4> texture{is_right ? t[0] + t[2] : t[0], is_top ? t[1] + t[3] : t[1],
                                         0, 1};
      if (draw.textured) inputs[is_named ? "piglit_texcoord" : "gl_MultiTexCoord0"] = texture;
      // A rectangle without texture coordinates has the current ones, (0, 0, 0, 1).
      if (!draw.textured && !is_named) inputs["gl_MultiTexCoord0"] = {0, 0, 0, 1};
      corners.push_back(shaded_.size());
      if (const auto refused = shade(inputs, draw)) return refused;
    }
    return check_work(corners.size(), draw);
  }

  Refused check_work(std::size_t corners, const DrawCommand& draw) {
    corner_count_ += corners;
    const std::size_t tokens = (vertex_->main.size() + 1) * (vertex_->globals.size() + 1);
    if (corner_count_ <= kMaxVertices && tokens <= kMaxWork / (shaded_.size() + 1)) {
      return std::nullopt;
    }
    return Refusal{draw.line, "is more than a case should have: too many vertices"};
  }

  Refused shade(const Inputs& inputs, const DrawCommand& draw) {
    const VertexRun run(*vertex_, inputs, draw.state.projection.has_value());
    const Expected<Value> position = run.value("gl_Position");
    if (!position) return named("gl_Position", position.error(), vertex_->main_line);
    if (position->defined != 0xF) {
      return Refusal{vertex_->main_line, "gl_Position is assigned in part"};
    }
    if (const auto refused = fix_projection(position->is_projected)) return refused;
    const auto& n = position->numbers;
    Shaded shaded{{n[0], n[1], n[2], n[3]}, {}, {}};
    bool is_rounded = position->is_rounded;
    if (const auto refused = add_attributes(run, shaded, is_rounded)) return refused;
    if (const auto refused = add_distances(run, *position, draw, shaded, is_rounded))
      return refused;
    rounded_ += is_rounded ? 1 : 0;
    shaded_.push_back(std::move(shaded));
    return std::nullopt;
  }

  Refused fix_projection(bool is_projected) {
    if (!is_projected || c_.camera) return std::nullopt;
    c_.camera.emplace();
    c_.camera->projection = *state().projection;
    if (state().is_projection_rounded) {
      note("the projection has numbers that were rounded to float32; a driver's may be others");
    }
    return std::nullopt;
  }

  /// Main has no branches that count, so that what the first vertex lacks, all lack.
  Refused add_attributes(const VertexRun& run, Shaded& shaded, bool& is_rounded) {
    for (auto v = varyings_.begin(); v != varyings_.end();) {
      const unsigned all = (1U << static_cast<unsigned>(v->components)) - 1;
      const Expected<Value> value = run.value(v->variable);
      if (!value && run.is_assigned(v->variable)) {
        return named(v->variable, value.error(), vertex_->main_line);
      }
      if (!value || value->defined != all) {
        note("{} left out: the vertex shader does not assign {} of it", printable(v->name),
             value ? "some" : "any");
        v = varyings_.erase(v);
        continue;
      }
      if (value->is_projected) {
        return Refusal{vertex_->main_line, fmt::format("{} is a projected position", v->variable)};
      }
      is_rounded = is_rounded || value->is_rounded;
      for (std::size_t i = 0; i < static_cast<std::size_t>(v->components); ++i) {
        float number = value->numbers.at(i);
        // Colours of vertices are clamped (OpenGL 4.6 compatibility profile, section 12.4.6).
        if (v->is_colour) number = std::clamp(number, 0.0F, 1.0F);
        shaded.attributes.push_back(number);
      }
      ++v;
    }
    return std::nullopt;
  }

  /// The distances of planes that are enabled: those that the shader writes, else of the planes.
  Refused add_distances(const VertexRun& run, const Value& position, const DrawCommand& draw,
                        Shaded& shaded, bool& is_rounded) {
    for (std::size_t i = 0; i < kPlanes; ++i) {
      if (!draw.state.enabled.at(i)) continue;
      const bool is_written = vertex_->mentions("gl_ClipDistance");
      const std::string name =
          is_written ? fmt::format("gl_ClipDistance[{}]", i) : std::string("gl_ClipVertex");
      const bool is_by_position = !is_written && !run.is_assigned(name);
      const Expected<Value> value = is_by_position ? Expected<Value>(position) : run.value(name);
      if (!value) {
        return named(name, value.error(), draw.line);
      }
      if (value->is_projected) {
        return Refusal{draw.line,
                       "clips projected positions with planes: a case has clip "
                       "distances, which are then no float32"};
      }
      if (value->defined != (is_written ? 1U : 0xFU)) {
        return Refusal{vertex_->main_line, fmt::format("{} is assigned in part", name)};
      }
      const auto [distance, is_inexact] = is_written ? std::pair(value->numbers[0], false)
                                                     : dot(draw.state.planes.at(i), value->numbers);
      if (!std::isfinite(distance)) {
        return Refusal{draw.line, "has a clip distance that is NaN or infinite"};
      }
      is_rounded = is_rounded || is_inexact || value->is_rounded;
      shaded.distances.push_back(distance);
    }
    return std::nullopt;
  }

  /// Which of the numbers of each vertex become attributes.
  std::vector<std::size_t> choose_columns() {
    std::vector<std::size_t> held;
    std::size_t column = 0;
    std::size_t too_many = 0;
    for (const Varying& v : varyings_) {
      for (int i = 0; i < v.components; ++i, ++column) {
        const std::string name =
            v.components == 1 ? v.name
                              : fmt::format("{}.{}", v.name, "xyzw"[static_cast<std::size_t>(i)]);
        const bool is_held =
            std::all_of(c_.triangles.begin(), c_.triangles.end(), [&](const Triangle& t) {
              return std::all_of(t.begin(), t.end(), [&](std::uint32_t k) {
                return std::isfinite(shaded_[k].attributes[column]);
              });
            });
        if (!is_held) {
          note("{} left out: a number is NaN or infinite", printable(name));
        } else if (held.size() == kMaxAttributes) {
          ++too_many;
        } else {
          held.push_back(column);
          c_.attributes.push_back({printable(name), v.interpolation, v.location});
        }
      }
    }
    if (too_many > 0) {
      note("{} attribute{} left out: a case has {} at most", too_many, plural(too_many),
           kMaxAttributes);
    }
    return held;
  }

  /// Adds the vertices that triangles use, and numbers them anew.
  Refused add_vertices() {
    if (c_.triangles.empty()) {
      return Refusal{drawn_.front()->line, "has no triangle that could be drawn"};
    }
    const std::vector<std::size_t> columns = choose_columns();
    std::map<std::uint32_t, std::uint32_t> added;
    c_.clip_distance_count = shaded_.front().distances.size();
    for (Triangle& triangle : c_.triangles) {
      for (std::uint32_t& corner : triangle) {
        const auto [at, is_new] =
            added.emplace(corner, static_cast<std::uint32_t>(c_.positions.size()));
        const Shaded& from = shaded_[corner];
        corner = at->second;
        if (!is_new) continue;
        c_.positions.push_back(from.position);
        for (const std::size_t i : columns) c_.attribute_values.push_back(from.attributes[i]);
        c_.clip_distances.insert(c_.clip_distances.end(), from.distances.begin(),
                                 from.distances.end());
      }
    }
    return std::nullopt;
  }

  void add_last_notes() {
    if (lost_ > 0) {
      note("{} triangle{} left out: a position is NaN or infinite", lost_, plural(lost_));
    }
    if (rounded_ > 0) {
      note(
          "the shader's arithmetic was rounded to float32 in {} vert{}; a driver may round "
          "otherwise",
          rounded_, rounded_ == 1 ? "ex" : "ices");
    }
    if (is_turned_) {
      note(
          "triangles are turned: flat attributes come from the last vertex in a case, and from "
          "the first one in the test");
    }
    if (is_split_) note("quads and polygons are split into triangles as Mesa does");
    if (script_->probes > 0) {
      note("{} probe{} left out: a case says nothing about the test's colours", script_->probes,
           plural(script_->probes));
    }
  }

  const Script* script_;
  const Shader* vertex_;
  const Shader* fragment_;
  std::vector<const DrawCommand*> drawn_;
  std::vector<Varying> varyings_;
  std::vector<Shaded> shaded_;
  std::map<std::size_t, std::size_t> by_row_;
  std::size_t corner_count_ = 0;
  std::size_t lost_ = 0;
  std::size_t rounded_ = 0;  ///< vertices
  bool is_turned_ = false;
  bool is_split_ = false;
  Case c_;
  std::vector<std::string> notes_;
};

Expected<Imported> import_script(const Script& script, const std::string& file) {
  const Expected<Shader> vertex = read_shader(script.vertex_shader, false);
  if (!vertex) return tl::unexpected(vertex.error());
  const Expected<Shader> fragment = read_shader(script.fragment_shader, true);
  if (!fragment) return tl::unexpected(fragment.error());
  if (vertex->main_line == 0) {
    return tl::unexpected(
        Refusal{script.vertex_shader.front().number, "the vertex shader has no main()"});
  }
  return Maker(script, *vertex, *fragment).make(file);
}

Result<Imported> import(std::string_view text, const std::string& file,
                        const ImportOptions& options) {
  if (options != ImportOptions{}) {
    return tl::unexpected(Error{file, "",
                                "is a piglit test, which says all itself and takes no "
                                "option"});
  }
  Expected<Imported> imported =
      read_script(text).and_then([&](const Script& script) { return import_script(script, file); });
  if (!imported) {
    return tl::unexpected(
        Error{file, fmt::format("line {}", imported.error().line), imported.error().reason});
  }
  return *std::move(imported);
}

const ImporterRegistration kRegistration({"shader_test", "a test for piglit's shader_runner",
                                          &begins_like_a_test, &import});

}  // namespace
}  // namespace rastercheck::cases::shader_test_importer
