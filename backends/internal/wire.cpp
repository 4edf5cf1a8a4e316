#include "backends/internal/wire.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>
#include <vector>

#include "cases/json_members.h"
#include "cases/names.h"
#include "cases/topology.h"

namespace rastercheck::backends {
namespace {

/// The number of values of an enumeration.
template <typename Enum>
constexpr std::size_t count_of(Enum value) {
  return names_of(value).size();
}
constexpr std::size_t count_of(cases::Winding /*type*/) { return 3; }
constexpr std::size_t count_of(cases::DepthError /*type*/) { return 3; }
constexpr std::size_t count_of(cases::KeptDepth /*type*/) { return 4; }
constexpr std::size_t count_of(cases::Claim /*type*/) { return 2; }
constexpr std::size_t count_of(Failure /*type*/) { return 5; }
constexpr std::size_t count_of(Question /*type*/) { return 5; }
constexpr std::size_t count_of(cases::DepthFunction /*type*/) { return 8; }
constexpr std::size_t count_of(cases::ColorFormat /*type*/) { return 2; }
constexpr std::size_t count_of(cases::Shading /*type*/) { return 6; }
constexpr std::size_t count_of(cases::Wrap /*type*/) { return 3; }
constexpr std::size_t count_of(cases::Filter /*type*/) { return 3; }

/// True for arithmetic types except bool, and for aggregates of such types, whose bytes are copied
/// as they are.
template <typename T>
constexpr bool kIsPlain = std::is_arithmetic_v<T> && !std::is_same_v<T, bool>;
template <typename T, std::size_t N>
constexpr bool kIsPlain<std::array<T, N>> = kIsPlain<T>;
template <>
constexpr bool kIsPlain<cases::FramebufferSize> = true;
template <>
constexpr bool kIsPlain<cases::Viewport> = true;
template <>
constexpr bool kIsPlain<cases::Scissor> = true;
template <>
constexpr bool kIsPlain<cases::ClipVertex> = true;
template <>
constexpr bool kIsPlain<cases::Camera> = true;
template <>
constexpr bool kIsPlain<cases::DepthBias> = true;
template <>
constexpr bool kIsPlain<cases::MagnitudeRange> = true;
template <>
constexpr bool kIsPlain<cases::PixelFraction> = true;
template <>
constexpr bool kIsPlain<cases::ValueBounds> = true;
template <>
constexpr bool kIsPlain<cases::TextureBounds> = true;

/// Calls `archive` with all members of a value. The same list of members serves reading and
/// writing.
template <typename Archive, cases::Either<Error> T>
void members(Archive& archive, T& e) {
  archive(e.file, e.place, e.reason, e.failure);
}
template <typename Archive, cases::Either<cases::Attribute> T>
void members(Archive& archive, T& a) {
  archive(a.name, a.interpolation, a.location);
}
template <typename Archive, cases::Either<cases::Snapping> T>
void members(Archive& archive, T& s) {
  archive(s.subpixel_bits, s.rounding, s.position_error, s.rounding_of_y, s.odd_steps);
}
template <typename Archive, cases::Either<cases::Found> T>
void members(Archive& archive, T& f) {
  archive(f.law, f.backend, f.verdict, f.seed, f.index, f.kind, f.condition);
}
template <typename Archive, cases::Either<cases::Case> T>
void members(Archive& archive, T& c) {
  archive(c.name, c.framebuffer, c.viewport, c.rules, c.coverage, c.basis, c.fill_rule, c.cull,
          c.front_face, c.scissor, c.depth_test, c.depth_clear, c.depth_clamp, c.depth_bias,
          c.depth_format, c.attributes, c.camera, c.positions, c.attribute_values, c.clip_distances,
          c.clip_distance_count, c.primitive, c.triangles, c.line_width, c.line_mode, c.point_size,
          c.essential, c.choices, c.found);
}
template <typename Archive, cases::Either<cases::TrianglePromise> T>
void members(Archive& archive, T& p) {
  archive(p.is_made, p.position_error, p.clip_tolerance, p.clip_error, p.side_tolerance, p.bounds);
}
template <typename Archive, cases::Either<cases::Conservative> T>
void members(Archive& archive, T& c) {
  archive(c.kind, c.error, c.growth, c.corners, c.covers_degenerates);
}
template <typename Archive, cases::Either<cases::BiasPromise> T>
void members(Archive& archive, T& b) {
  archive(b.slope, b.unit, b.exponent);
}
template <typename Archive, cases::Either<cases::PictureBounds> T>
void members(Archive& archive, T& b) {
  archive(b.keeps_fragments, b.resolves_to_mean, b.float_error, b.byte_store, b.byte_blend,
          b.byte_mean, b.texel_share, b.texel_distance);
}
template <typename Archive, cases::Either<cases::Contract> T>
void members(Archive& archive, T& c) {
  archive(c.numbers, c.coverage, c.basis, c.tie_rule, c.conservative, c.guard_band,
          c.guard_beyond_viewport, c.culls_instead_of_clipping, c.culls, c.least_area,
          c.sample_position, c.depth_function, c.depth_error, c.is_on_grid, c.clip_tolerance,
          c.clip_error, c.viewport_error, c.depth_format, c.depth_store, c.depth_bias, c.claims,
          c.bounds, c.keeps_equal_depth, c.keeps_constants, c.keeps_sign_of_zero, c.is_invariant,
          c.keeps_vertex_values, c.derivative_bound, c.transform_bound, c.normal_bound,
          c.quad_share, c.texture_bounds, c.picture_bounds, c.triangles);
}
template <typename Archive, cases::Either<cases::Fragments> T>
void members(Archive& archive, T& f) {
  archive(f.attribute_count, f.triangle, f.x, f.y, f.sample, f.depth, f.attributes, f.derivatives);
}
template <typename Archive, cases::Either<cases::Texture> T>
void members(Archive& archive, T& t) {
  archive(t.width, t.height, t.texels);
}
template <typename Archive, cases::Either<cases::Texturing> T>
void members(Archive& archive, T& t) {
  archive(t.texture, t.wrap_s, t.wrap_t, t.filter);
}
template <typename Archive, cases::Either<cases::Pipeline> T>
void members(Archive& archive, T& p) {
  archive(p.depth_function, p.writes_depth, p.clear_depth, p.blend, p.format, p.shading,
          p.texturing, p.discard_below, p.resolves);
}
template <typename Archive, cases::Either<cases::Picture> T>
void members(Archive& archive, T& p) {
  archive(p.size, p.channels, p.color, p.depth);
}
template <typename Archive, cases::Either<Request> T>
void members(Archive& archive, T& r) {
  archive(r.question, r.source, r.way, r.occluders, r.pipeline, r.topology, r.indices);
}
template <typename Archive, cases::Either<Driver> T>
void members(Archive& archive, T& d) {
  archive(d.name, d.version);
}
template <typename Archive, cases::Either<ApiLimits> T>
void members(Archive& archive, T& l) {
  archive(l.subpixel_bits, l.is_software, l.viewport_subpixel_bits, l.subtexel_bits);
}
template <typename Archive, cases::Either<cases::Capabilities> T>
void members(Archive& archive, T& c) {
  archive(c.rules, c.sample_counts, c.primitives, c.lacks, c.max_size, c.size_multiple,
          c.max_viewport, c.max_attributes, c.max_clip_distances, c.numbers);
}
template <typename Archive, cases::Either<About> T>
void members(Archive& archive, T& a) {
  archive(a.description, a.driver, a.api, a.has_limits, a.capabilities, a.same_as, a.ways,
          a.answers_occlusion_queries, a.draws_pictures, a.assembles);
}
template <typename Archive, cases::Either<Greeting> T>
void members(Archive& archive, T& g) {
  archive(g.about, g.problem);
}
template <typename Archive, cases::Either<Drawn> T>
void members(Archive& archive, T& d) {
  archive(d.contract, d.fragments);
}
template <typename Archive, cases::Either<DrawingAnswer> T>
void members(Archive& archive, T& d) {
  archive(d.drawn, d.problem);
}
template <typename Archive, cases::Either<OcclusionAnswer> T>
void members(Archive& archive, T& a) {
  archive(a.is_occluded, a.problem);
}

template <typename Archive, cases::Either<PictureAnswer> T>
void members(Archive& archive, T& a) {
  archive(a.picture, a.problem);
}

class Packer {
 public:
  template <typename... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  std::string take() { return std::move(bytes_); }

 private:
  void append(const void* from, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(from), size);
  }
  void put_size(std::uint64_t size) { append(&size, sizeof size); }

  template <typename T>
  void put(const T& value) {
    if constexpr (kIsPlain<T>) {
      append(&value, sizeof value);
    } else if constexpr (std::is_enum_v<T> || std::is_same_v<T, bool>) {
      bytes_ += static_cast<char>(value);
    } else {
      members(*this, value);
    }
  }
  void put(const std::string& text) {
    put_size(text.size());
    append(text.data(), text.size());
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    put_size(values.size());
    if constexpr (kIsPlain<T>) {
      append(values.data(), values.size() * sizeof(T));
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <typename T>
  void put(const std::optional<T>& value) {
    bytes_ += static_cast<char>(value.has_value());
    if (value) put(*value);
  }

  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  template <typename... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  /// True if nothing has failed and no bytes are left.
  bool is_whole() const { return !has_failed_ && rest_.empty(); }

 private:
  /// Copies `size` bytes. If fewer are left, returns false, and every later read fails.
  bool take(void* to, std::size_t size) {
    if (has_failed_ || size > rest_.size()) {
      has_failed_ = true;
      return false;
    }
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
    return true;
  }
  /// Reads the number of elements that follow, each of at least `size` bytes; 0 if fewer bytes are
  /// left than they need.
  std::size_t get_count(std::size_t size) {
    std::uint64_t count = 0;
    if (!take(&count, sizeof count)) return 0;
    if (count > rest_.size() / size) {
      has_failed_ = true;
      return 0;
    }
    return static_cast<std::size_t>(count);
  }
  /// Reads a byte, which must be below `count`.
  std::uint8_t get_byte(std::size_t count) {
    std::uint8_t byte = 0;
    take(&byte, 1);
    if (byte < count) return byte;
    has_failed_ = true;
    return 0;
  }

  template <typename T>
  void get(T& value) {
    if constexpr (kIsPlain<T>) {
      take(&value, sizeof value);
    } else if constexpr (std::is_same_v<T, bool>) {
      value = get_byte(2) != 0;
    } else if constexpr (std::is_enum_v<T>) {
      value = static_cast<T>(get_byte(count_of(T{})));
    } else {
      members(*this, value);
    }
  }
  void get(std::string& text) {
    text.resize(get_count(1));
    take(text.data(), text.size());
  }
  template <typename T>
  void get(std::vector<T>& values) {
    if constexpr (kIsPlain<T>) {
      values.resize(get_count(sizeof(T)));
      take(values.data(), values.size() * sizeof(T));
    } else {
      values.resize(get_count(1));
      for (T& value : values) get(value);
    }
  }
  template <typename T>
  void get(std::optional<T>& value) {
    if (get_byte(2) != 0) get(value.emplace());
  }

  std::string_view rest_;
  bool has_failed_ = false;
};

template <typename T>
std::string packed(const T& value) {
  Packer packer;
  packer(value);
  return packer.take();
}

template <typename T>
std::optional<T> unpacked(std::string_view bytes) {
  T value;
  Unpacker unpacker(bytes);
  unpacker(value);
  return unpacker.is_whole() ? std::optional(std::move(value)) : std::nullopt;
}

void add_sizes(const cases::ValueBounds& bounds, std::vector<double>& sizes) {
  for (const cases::ValueBound& bound : {bounds.smooth, bounds.noperspective, bounds.depth}) {
    sizes.insert(sizes.end(), {bound.constant, bound.per_horizon, bound.per_condition,
                               bound.range_share, bound.absolute});
  }
}

bool has_meaning(const cases::Snapping& grid) {
  return grid.subpixel_bits >= 0 && grid.subpixel_bits <= cases::kMaxSubpixelBits &&
         grid.odd_steps >= 1 && grid.odd_steps % 2 == 1 &&
         grid.odd_steps <= cases::kMaxGridSteps >> grid.subpixel_bits && grid.position_error >= 0 &&
         grid.position_error <= cases::kMaxPositionError;
}

/// True if each number of the contract is in the range that contracts allow.
bool has_meaning(const cases::Contract& c) {
  std::vector<double> sizes{c.numbers.least,
                            c.numbers.greatest,
                            c.guard_band,
                            c.guard_beyond_viewport.value_or(0),
                            c.least_area,
                            c.clip_tolerance,
                            c.clip_error,
                            c.viewport_error,
                            c.derivative_bound.value_or(0),
                            c.transform_bound.value_or(0),
                            c.normal_bound.value_or(0),
                            c.quad_share.value_or(0)};
  add_sizes(c.bounds, sizes);
  bool is_placeable = true;
  for (const cases::TrianglePromise& promise : c.triangles) {
    add_sizes(promise.bounds, sizes);
    sizes.insert(sizes.end(), {promise.clip_tolerance, promise.clip_error, promise.side_tolerance});
    is_placeable = is_placeable && promise.position_error >= 0 &&
                   promise.position_error <= cases::kMaxPositionError;
  }
  if (!is_placeable) return false;
  if (c.conservative) {
    const auto& [kind, error, growth, corners, covers_degenerates] = *c.conservative;
    sizes.insert(sizes.end(), {error, growth});
    if (std::max(error, growth) > cases::kMaxConservativeReach) return false;
  }
  if (c.texture_bounds) {
    const cases::TextureBounds& bounds = *c.texture_bounds;
    sizes.insert(sizes.end(), {bounds.coordinate_share, bounds.coordinate_constant, bounds.bilinear,
                               bounds.trilinear, bounds.derivative_share});
  }
  if (c.picture_bounds) {
    const cases::PictureBounds& bounds = *c.picture_bounds;
    sizes.insert(sizes.end(), {bounds.float_error, bounds.byte_store, bounds.byte_blend,
                               bounds.byte_mean, bounds.texel_share, bounds.texel_distance});
  }
  if (!std::all_of(sizes.begin(), sizes.end(), [](double size) { return size >= 0; })) return false;
  if (c.sample_position) {
    const cases::PixelFraction& at = *c.sample_position;
    const bool is_inside = at.parts >= 1 && at.parts <= cases::kMostPixelParts && at.x >= 0 &&
                           at.x < at.parts && at.y >= 0 && at.y < at.parts;
    if (!is_inside) return false;
  }
  return !c.coverage || has_meaning(*c.coverage);
}

}  // namespace

std::string pack(const Request& request) { return packed(request); }
std::string pack(const Greeting& greeting) { return packed(greeting); }
std::string pack(const DrawingAnswer& drawing) { return packed(drawing); }
std::string pack(const cases::Contract& contract) { return packed(contract); }
std::string pack(const OcclusionAnswer& answer) { return packed(answer); }
std::string pack(const PictureAnswer& answer) { return packed(answer); }

std::optional<Request> unpack_request(std::string_view bytes) {
  std::optional<Request> request = unpacked<Request>(bytes);
  const bool is_query = request && request->question == Question::occlusion;
  if (is_query && request->occluders >= request->source.triangles.size()) return std::nullopt;
  return request;
}
std::optional<Greeting> unpack_greeting(std::string_view bytes) {
  std::optional<Greeting> greeting = unpacked<Greeting>(bytes);
  if (greeting && !has_meaning(greeting->about.capabilities)) return std::nullopt;
  return greeting;
}
std::optional<DrawingAnswer> unpack_drawing(std::string_view bytes) {
  std::optional<DrawingAnswer> drawing = unpacked<DrawingAnswer>(bytes);
  if (drawing && !drawing->problem && !has_meaning(drawing->drawn.contract)) return std::nullopt;
  return drawing;
}
std::optional<cases::Contract> unpack_contract(std::string_view bytes) {
  std::optional<cases::Contract> contract = unpacked<cases::Contract>(bytes);
  if (contract && !has_meaning(*contract)) return std::nullopt;
  return contract;
}

std::optional<OcclusionAnswer> unpack_occlusion(std::string_view bytes) {
  return unpacked<OcclusionAnswer>(bytes);
}

std::optional<PictureAnswer> unpack_picture(std::string_view bytes) {
  return unpacked<PictureAnswer>(bytes);
}

}  // namespace rastercheck::backends
