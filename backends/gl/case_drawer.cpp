#include "backends/gl/case_drawer.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "backends/appended_drawing.h"
#include "backends/gl/internal/capabilities.h"
#include "backends/gl/internal/case_program.h"
#include "backends/gl/internal/case_state.h"
#include "backends/gl/internal/fragment_buffer.h"
#include "backends/gl/internal/layer_store.h"
#include "backends/gl/internal/layers.h"
#include "backends/gl/internal/objects.h"
#include "backends/gl/internal/picture_drawing.h"
#include "backends/gl/internal/varyings.h"
#include "backends/indexed_draw.h"
#include "backends/unorm_depth.h"
#include "backends/upright_viewport.h"
#include "cases/json.h"

namespace rastercheck::backends::gl {
namespace {

/// The most driver memory for all layers that are drawn before they are read.
constexpr std::size_t kBytesOfBatch = std::size_t{16} << 20U;
constexpr int kMostLayers = 64;
/// The depth where nothing is drawn, which is greater than that of any fragment.
constexpr float kFarthest = 2;

/// The fragments of a layer, sorted by place.
struct LayerFragments {
  std::vector<std::uint32_t> triangle;
  std::vector<std::size_t> at;     ///< index of the layer's sample in LayerContent
  std::vector<std::size_t> place;  ///< [y][x][sample], samples in the standard order
  std::vector<float> depth;
  std::vector<float> attributes;  ///< [fragment][attribute]
};

/// The settings that all batches of a case share.
struct Batches {
  const cases::Case* c = nullptr;
  const IndexedDraw* indexed = nullptr;  ///< drawn in place of lists, if given
  std::vector<Pass> passes;
  int layers = 1;                  ///< per batch
  std::size_t triangles = 1;       ///< per layer
  std::vector<std::size_t> order;  ///< the driver's index of each standard sample
  DepthReading depth;
};

std::uint32_t triangle_of(float number, std::size_t first, std::size_t count, bool& is_one) {
  is_one = number >= 1 && number <= static_cast<float>(count) && number == std::floor(number);
  return is_one ? static_cast<std::uint32_t>(first + static_cast<std::size_t>(number) - 1) : 0;
}

void append(const LayerFragments& some, const cases::Case& c, cases::Fragments& all) {
  std::vector<std::size_t> sorted(some.triangle.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  std::stable_sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    return some.triangle[a] < some.triangle[b];
  });
  const auto samples = static_cast<std::size_t>(c.framebuffer.samples);
  const auto width = static_cast<std::size_t>(c.framebuffer.width);
  const auto count = static_cast<std::ptrdiff_t>(c.attributes.size());
  for (const std::size_t i : sorted) {
    const std::size_t pixel = some.place[i] / samples;
    all.triangle.push_back(some.triangle[i]);
    all.x.push_back(static_cast<std::uint16_t>(pixel % width));
    all.y.push_back(static_cast<std::uint16_t>(pixel / width));
    all.sample.push_back(static_cast<std::uint8_t>(some.place[i] % samples));
    all.depth.push_back(some.depth[i]);
    const auto first = some.attributes.begin() + static_cast<std::ptrdiff_t>(i) * count;
    all.attributes.insert(all.attributes.end(), first, first + count);
  }
}

}  // namespace

struct CaseDrawer::Impl {
  Impl() : has(read_capabilities()), programs(has), store(has), pictures(has, store) {
    listen();
    if (has.has_appending) buffer.emplace(has, programs);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (listens) glDebugMessageCallback(nullptr, nullptr);
  }

  void listen();
  Result<void> complain() const;

  Result<void> prepare();
  Result<Batches> plan(const cases::Case& c);
  Result<void> draw_pass(const Batches& plan, const Pass& pass, std::size_t first, int layer_count,
                         Layers& layers);
  Result<void> draw_batch(const Batches& plan, std::size_t first, cases::Fragments& drawn);
  Result<cases::Fragments> draw_layers(const cases::Case& c, const IndexedDraw* indexed,
                                       const std::function<void()>& go_on);
  Result<cases::Fragments> append_all(const cases::Case& c, const IndexedDraw* indexed,
                                      bool is_checked, const std::function<void()>& go_on);
  bool appends(const cases::Case& c) const;
  Result<void> recover_depths(const Batches& plan, const Pass& pass, std::size_t layer,
                              Layers& layers);
  Result<void> find_fragments(const Batches& plan, std::size_t first, LayerFragments& found) const;
  Result<void> take_values(const Batches& plan, const Pass& pass, LayerFragments& found) const;

  Capabilities has;
  bool listens = false;   ///< whether the driver reports errors as text
  std::string complaint;  ///< the driver's first message on the current case
  CasePrograms programs;
  LayerStore store;
  Object vertex_array;
  Object vertices;
  Object indices;
  LayerContent content;
  std::optional<FragmentBuffer> buffer;
  PictureDrawing pictures;
};

CaseDrawer::CaseDrawer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
CaseDrawer::CaseDrawer(CaseDrawer&& other) noexcept = default;
CaseDrawer& CaseDrawer::operator=(CaseDrawer&& other) noexcept = default;
CaseDrawer::~CaseDrawer() = default;

Result<CaseDrawer> CaseDrawer::create(const Context& /*context*/) {
  auto impl = std::make_unique<Impl>();
  return impl->prepare().map([&] { return CaseDrawer(std::move(impl)); });
}

int CaseDrawer::subpixel_bits() const { return impl_->has.subpixel_bits; }
cases::Capabilities CaseDrawer::capabilities() const { return drawable(impl_->has); }
int CaseDrawer::viewport_subpixel_bits() const { return impl_->has.viewport_subpixel_bits; }

/// Enables error messages as text, if the driver has them.
void CaseDrawer::Impl::listen() {
  listens = !has.is_es && (has.version >= 43 || epoxy_has_gl_extension("GL_KHR_debug"));
  if (!listens) return;
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  const GLDEBUGPROC note = [](GLenum, GLenum type, GLuint, GLenum severity, GLsizei,
                              const GLchar* text, const void* impl) {
    // Casting const away is safe, because the pointer handed over was not const.
    auto* const self = static_cast<Impl*>(const_cast<void*>(impl));
    const bool is_error = type == GL_DEBUG_TYPE_ERROR && severity == GL_DEBUG_SEVERITY_HIGH;
    if (is_error && self->complaint.empty()) self->complaint = cases::one_line(text);
  };
  glDebugMessageCallback(note, this);
}

Result<void> CaseDrawer::Impl::complain() const {
  if (complaint.empty()) return {};
  return failure("the driver says: " + complaint);
}

/// Checks that the context can draw into float32, and finds out to which depths it can clear.
Result<void> CaseDrawer::Impl::prepare() {
  if (has.is_es && !epoxy_has_gl_extension("GL_EXT_color_buffer_float")) {
    return failure(has.api + " cannot draw into float32 targets (no GL_EXT_color_buffer_float)");
  }
  vertex_array = generate_vertex_array();
  vertices = generate_buffer();
  indices = generate_buffer();
  const Result<Layers*> layers = store.get({{1, 1, 1}, 1, 1});
  if (!layers) return tl::unexpected(layers.error());
  glBindFramebuffer(GL_FRAMEBUFFER, (*layers)->framebuffer(0));
  const std::array<GLfloat, 4> one = {1, 0, 0, 0};
  glClearBufferfv(GL_COLOR, 0, one.data());
  glClearBufferfv(GL_DEPTH, 0, &kFarthest);
  const std::vector<bool> none(1);
  if (auto read = (*layers)->read(0, none, content); !read) return read;
  if (content.is_empty)
    return failure("a cleared target does not return the value that it was cleared to");
  has.clears_beyond_one = content.depth[0] == kFarthest;
  return {};
}

Result<Batches> CaseDrawer::Impl::plan(const cases::Case& c) {
  if (const std::string what = lacks(has, c); !what.empty()) {
    return unsupported(what);
  }
  Batches plan;
  plan.c = &c;
  plan.passes = pack(c.attributes, c.framebuffer.samples, has.has_noperspective);
  const bool is_together = c.depth_test == cases::DepthTest::less;
  plan.triangles = is_together ? c.triangles.size() : 1;
  const LayerShape one{c.framebuffer, 1, plan.passes.front().size(), c.depth_format};
  const std::size_t bytes = one.bytes_of_layer();
  if (bytes > kMostBytesOfLayer) {
    return unsupported(fmt::format("a triangle needs {} MiB; the limit is {} MiB", bytes >> 20U,
                                   kMostBytesOfLayer >> 20U));
  }
  const std::size_t most =
      std::min({static_cast<std::size_t>(std::min(kMostLayers, has.max_layers)),
                std::max(kBytesOfBatch / bytes, std::size_t{1}), c.triangles.size()});
  plan.layers = is_together ? 1 : static_cast<int>(most);
  const Result<DepthReading> depth = store.depth_reading(c);
  if (!depth) return tl::unexpected(depth.error());
  plan.depth = *depth;
  Result<std::vector<std::size_t>> order = store.sample_order(one);
  if (!order) return tl::unexpected(order.error());
  plan.order = *std::move(order);
  return plan;
}

/// Draws the triangles from `first` on, an equal number into each layer.
Result<void> CaseDrawer::Impl::draw_pass(const Batches& plan, const Pass& pass, std::size_t first,
                                         int layer_count, Layers& layers) {
  const cases::Case& c = *plan.c;
  const std::size_t count = static_cast<std::size_t>(layer_count) * plan.triangles;
  const Result<GLuint> program = programs.get(c, pass);
  if (!program) return tl::unexpected(program.error());
  hand_over_vertices(has, pass,
                     plan.indexed != nullptr
                         ? vertices_of(has, c, *plan.indexed, pass)
                         : vertices_of(has, c, std::span(c.triangles).subspan(first, count), pass),
                     vertex_array.name(), vertices.name());
  use_program(*program, c);
  set_case_state(has, c);
  constexpr std::array<GLfloat, 4> kNoNumber{};
  const bool is_beyond_one = has.clears_beyond_one && c.depth_format == cases::DepthFormat::float32;
  const float farthest = c.depth_clear.value_or(is_beyond_one ? kFarthest : 1.0F);
  for (std::size_t layer = 0; layer < static_cast<std::size_t>(layer_count); ++layer) {
    glBindFramebuffer(GL_FRAMEBUFFER, layers.framebuffer(layer));
    glDisable(GL_SCISSOR_TEST);
    glClearBufferfv(GL_COLOR, 0, kNoNumber.data());
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    set_scissor(c);
    if (plan.indexed != nullptr) {
      draw_indices(has, c, *plan.indexed, indices.name());
    } else {
      draw_primitives(c, layer * plan.triangles, plan.triangles);
    }
  }
  reset_case_state(has);
  return check("drawing");
}

/// Replaces the depths of fragments in `content`, which holds a layer, by those that were stored.
Result<void> CaseDrawer::Impl::recover_depths(const Batches& plan, const Pass& pass,
                                              std::size_t layer, Layers& layers) {
  if (!plan.depth.fetch || content.is_empty) return {};
  bool is_open = false;
  for (std::size_t i = 0; i < content.numbers.size() && !is_open; ++i) {
    is_open = content.numbers[i] != 0 && plan.depth.is_open(content.depth[i]);
  }
  LayerContent ones;
  if (is_open) {
    const cases::Case all = covering_at_one(*plan.c);
    const Result<GLuint> program = programs.get(all, pass);
    if (!program) return tl::unexpected(program.error());
    hand_over_vertices(has, pass, vertices_of(has, all, all.triangles, pass), vertex_array.name(),
                       vertices.name());
    use_program(*program, all);
    set_case_state(has, all);
    glDepthFunc(GL_EQUAL);
    constexpr std::array<GLfloat, 4> kNoNumber{};
    glBindFramebuffer(GL_FRAMEBUFFER, layers.framebuffer(layer));
    glDisable(GL_SCISSOR_TEST);
    glClearBufferfv(GL_COLOR, 0, kNoNumber.data());
    draw_primitives(all, 0, 1);
    reset_case_state(has);
    const std::vector<bool> none(pass.size());
    if (auto read = layers.read(layer, none, ones); !read) return read;
  }
  for (std::size_t i = 0; i < content.numbers.size(); ++i) {
    if (content.numbers[i] == 0) continue;
    const Result<float> depth =
        plan.depth.stored(content.depth[i], is_open && ones.numbers[i] != 0);
    if (!depth) return tl::unexpected(depth.error());
    content.depth[i] = *depth;
  }
  return {};
}

/// Finds the fragments in `content`, which holds triangles from `first` on.
Result<void> CaseDrawer::Impl::find_fragments(const Batches& plan, std::size_t first,
                                              LayerFragments& found) const {
  if (content.is_empty) return {};
  const std::size_t samples = plan.order.size();
  for (std::size_t i = 0; i < content.numbers.size(); ++i) {
    const std::size_t at = i - i % samples + plan.order[i % samples];
    const float number = content.numbers[at];
    if (number == 0) continue;
    bool is_one = false;
    const std::uint32_t triangle =
        triangle_of(number, first, plan.c->triangles.size() - first, is_one);
    if (!is_one) return failure(fmt::format("a flat triangle number was drawn as {}", number));
    found.triangle.push_back(triangle);
    found.at.push_back(at);
    found.place.push_back(i);
    found.depth.push_back(content.depth[at]);
  }
  found.attributes.resize(found.at.size() * plan.c->attributes.size());
  return {};
}

/// Copies the values that a pass drew, which must have the same fragments as the first pass.
Result<void> CaseDrawer::Impl::take_values(const Batches& plan, const Pass& pass,
                                           LayerFragments& found) const {
  const std::size_t attributes = plan.c->attributes.size();
  for (std::size_t i = 0; i < found.at.size(); ++i) {
    for (std::size_t v = 0; v < pass.size(); ++v) {
      for (std::size_t k = 0; k < pass[v].count; ++k) {
        found.attributes[i * attributes + pass[v].attributes[k]] =
            content.values[v][found.at[i]][k];
      }
    }
  }
  return {};
}

Result<void> CaseDrawer::Impl::draw_batch(const Batches& plan, std::size_t first,
                                          cases::Fragments& drawn) {
  const std::size_t left = (plan.c->triangles.size() - first) / plan.triangles;
  const int layer_count = static_cast<int>(std::min(left, static_cast<std::size_t>(plan.layers)));
  std::vector<LayerFragments> found(static_cast<std::size_t>(layer_count));
  for (const Pass& pass : plan.passes) {
    const LayerShape shape{plan.c->framebuffer, plan.layers, pass.size(), plan.c->depth_format};
    std::vector<bool> wanted;
    for (const Varying& varying : pass) wanted.push_back(varying.count > 0);
    const Result<Layers*> layers = store.get(shape);
    if (!layers) return tl::unexpected(layers.error());
    if (auto done = draw_pass(plan, pass, first, layer_count, **layers); !done) return done;
    for (std::size_t layer = 0; layer < found.size(); ++layer) {
      if (auto read = (*layers)->read(layer, wanted, content); !read) return read;
      if (&pass == &plan.passes.front()) {
        if (auto done = recover_depths(plan, pass, layer, **layers); !done) return done;
      }
      LayerFragments again;
      if (auto looked = find_fragments(plan, first, again); !looked) return looked;
      if (&pass == &plan.passes.front()) {
        found[layer] = std::move(again);
      } else if (again.at != found[layer].at || again.triangle != found[layer].triangle) {
        return failure("the same triangles covered other samples when they were drawn again");
      }
      if (auto taken = take_values(plan, pass, found[layer]); !taken) return taken;
    }
  }
  for (const LayerFragments& fragments : found) append(fragments, *plan.c, drawn);
  return {};
}

Result<cases::Fragments> CaseDrawer::Impl::draw_layers(const cases::Case& c,
                                                       const IndexedDraw* indexed,
                                                       const std::function<void()>& go_on) {
  cases::Fragments drawn;
  drawn.attribute_count = c.attributes.size();
  Result<Batches> batches = plan(c);
  if (!batches) return tl::unexpected(batches.error());
  batches->indexed = indexed;
  const std::size_t of_batch = static_cast<std::size_t>(batches->layers) * batches->triangles;
  for (std::size_t first = 0; first < c.triangles.size(); first += of_batch) {
    const Result<void> done = draw_batch(*batches, first, drawn);
    if (!done) return tl::unexpected(done.error());
    go_on();
  }
  return drawn;
}

Result<cases::Fragments> CaseDrawer::Impl::append_all(const cases::Case& c,
                                                      const IndexedDraw* indexed, bool is_checked,
                                                      const std::function<void()>& go_on) {
  std::string what = lacks_of_appending(c);
  if (!buffer) what = has.api + " has no storage buffers for fragments";
  if (what.empty()) what = lacks(has, c);
  if (!what.empty()) return unsupported(std::move(what));
  std::vector<Pass> passes = pack(c.attributes, c.framebuffer.samples, has.has_noperspective);
  std::vector<RecordLayout> layouts;
  for (Pass& pass : passes) {
    // Removes empty varyings to keep the records short.
    std::erase_if(pass, [](const Varying& varying) { return varying.count == 0; });
    RecordLayout& layout = layouts.emplace_back();
    for (const Varying& varying : pass) {
      layout.add_vector(std::span(varying.attributes).first(varying.count));
    }
  }
  const AppendingDriver driver{
      buffer->most_words(),
      [&](std::size_t layout, std::size_t first, std::size_t count,
          std::size_t room) -> Result<std::size_t> {
        if (indexed == nullptr) {
          return buffer->draw(c, std::span(c.triangles).subspan(first, count), passes[layout],
                              room);
        }
        if (count < c.triangles.size())
          return unsupported("its triangles or fragments are too many for one draw");
        return buffer->draw(c, *indexed, passes[layout], room);
      },
      [&] { return buffer->words(); },
      [&](const cases::Case& some) { return draw_layers(some, nullptr, go_on); }};
  return draw_appended(c, layouts, driver, is_checked, go_on);
}

/// True if fragments are appended when the caller names no way of drawing. That is the case only if
/// layers, which are read back whole, would take more than one batch.
bool CaseDrawer::Impl::appends(const cases::Case& c) const {
  if (!buffer || !lacks_of_appending(c).empty()) return false;
  const LayerShape one{c.framebuffer, 1, pack(c.attributes, 1, has.has_noperspective)[0].size()};
  return one.bytes_of_layer() * c.triangles.size() > kBytesOfBatch;
}

std::vector<cases::DrawBy> CaseDrawer::ways() const {
  if (!impl_->buffer) return {cases::DrawBy::layers};
  return {cases::DrawBy::append, cases::DrawBy::layers};
}

Result<cases::Fragments> CaseDrawer::draw(const cases::Case& c, std::optional<cases::DrawBy> way,
                                          const std::function<void()>& go_on) {
  if (const auto upright = with_upright_viewport(c, NegativeSizes::none)) {
    return draw(*upright, way, go_on);
  }
  impl_->complaint.clear();
  const bool appends = way ? *way == cases::DrawBy::append : impl_->appends(c);
  Result<cases::Fragments> drawn =
      appends ? impl_->append_all(c, nullptr, !way, go_on) : impl_->draw_layers(c, nullptr, go_on);
  if (!drawn) return drawn;
  if (const Result<void> quiet = impl_->complain(); !quiet) return tl::unexpected(quiet.error());
  return drawn;
}

Result<cases::Fragments> CaseDrawer::draw_assembled(const cases::Case& c, cases::Topology topology,
                                                    std::span<const std::uint32_t> indices,
                                                    const std::function<void()>& go_on) {
  // A triangle's number is a flat value, even if the case has none.
  if (!impl_->has.has_provoking_vertex && c.rules != cases::Rules::opengl) {
    return unsupported(impl_->has.api + " cannot choose the provoking vertex of strips");
  }
  const auto upright = with_upright_viewport(c, NegativeSizes::none);
  cases::Case drawn_case = upright ? *upright : c;
  const Result<IndexedDraw> indexed = indexed_draw(drawn_case, topology, indices);
  if (!indexed) return tl::unexpected(indexed.error());
  drawn_case.triangles = indexed->primitives;
  impl_->complaint.clear();
  const bool is_together = drawn_case.depth_test == cases::DepthTest::less;
  Result<cases::Fragments> drawn = is_together
                                       ? impl_->draw_layers(drawn_case, &*indexed, go_on)
                                       : impl_->append_all(drawn_case, &*indexed, false, go_on);
  if (!drawn) return drawn;
  if (const Result<void> quiet = impl_->complain(); !quiet) return tl::unexpected(quiet.error());
  return drawn;
}

Result<cases::Picture> CaseDrawer::draw_picture(const cases::Case& c,
                                                const cases::Pipeline& pipeline) {
  if (const auto upright = with_upright_viewport(c, NegativeSizes::none)) {
    return draw_picture(*upright, pipeline);
  }
  impl_->complaint.clear();
  Result<cases::Picture> drawn = impl_->pictures.draw(c, pipeline);
  if (!drawn) return drawn;
  if (const Result<void> quiet = impl_->complain(); !quiet) return tl::unexpected(quiet.error());
  return drawn;
}

}  // namespace rastercheck::backends::gl
