#include "tests/mutants/recording_backend.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

namespace rastercheck::mutants {
namespace {

using backends::Backend;

// True if two answers are the same. Numbers are compared bit for bit, because a law may distinguish
// −0 from 0 and one NaN from another.

bool is_same(bool a, bool b) { return a == b; }

bool is_same(const cases::Contract& a, const cases::Contract& b) { return a == b; }

bool is_same(const backends::About& a, const backends::About& b) { return a == b; }

/// For vectors of numbers, or of structs that contain only floats.
template <typename T>
requires std::is_trivially_copyable_v<T>
bool is_same(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool is_same(const cases::Fragments& a, const cases::Fragments& b) {
  return a.attribute_count == b.attribute_count && a.triangle == b.triangle && a.x == b.x &&
         a.y == b.y && a.sample == b.sample && is_same(a.depth, b.depth) &&
         is_same(a.attributes, b.attributes) && is_same(a.derivatives, b.derivatives);
}

bool is_same(const cases::Picture& a, const cases::Picture& b) {
  return a.size == b.size && a.channels == b.channels && is_same(a.color, b.color) &&
         is_same(a.depth, b.depth);
}

bool is_same(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_same(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

bool is_same(const std::string& a, const std::string& b) { return a == b; }

// Templates can call only overloads that are declared before them.
bool is_same(const std::array<float, 4>& a, const std::array<float, 4>& b);
bool is_same(const records::TracedCorner& a, const records::TracedCorner& b);
bool is_same(const records::TracedFrame& a, const records::TracedFrame& b);
bool is_same(const records::TracedLine& a, const records::TracedLine& b);
bool is_same(const records::TracedPlane& a, const records::TracedPlane& b);
bool is_same(const records::TracedValue& a, const records::TracedValue& b);
bool is_same(const std::vector<records::TracedValue>& a,
             const std::vector<records::TracedValue>& b);
template <typename T>
bool is_same(const std::array<T, 3>& a, const std::array<T, 3>& b);
template <typename T>
bool is_same(const std::optional<T>& a, const std::optional<T>& b);

/// Compares the arguments in pairs: the first with the second, the third with the fourth, and so
/// on.
template <typename T, typename... Rest>
bool are_same(const T& a, const T& b, const Rest&... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return is_same(a, b);
  } else {
    return is_same(a, b) && are_same(rest...);
  }
}

bool is_same(const records::TracedCorner& a, const records::TracedCorner& b) {
  return are_same(a.x, b.x, a.y, b.y, a.z, b.z, a.w, b.w, a.is_homogeneous, b.is_homogeneous,
                  a.share, b.share);
}

bool is_same(const records::TracedFrame& a, const records::TracedFrame& b) {
  return are_same(a.u.scale, b.u.scale, a.u.shift, b.u.shift, a.v.scale, b.v.scale, a.v.shift,
                  b.v.shift, a.t, b.t);
}

bool is_same(const records::TracedLine& a, const records::TracedLine& b) {
  return are_same(a.a, b.a, a.b, b.b, a.c, b.c);
}

bool is_same(const records::TracedPlane& a, const records::TracedPlane& b) {
  return are_same(a.a, b.a, a.b, b.b, a.c, b.c);
}

bool is_same(const records::TracedValue& a, const records::TracedValue& b) {
  return are_same(a.u, b.u, a.v, b.v, a.is_from_vertices, b.is_from_vertices, a.corners, b.corners,
                  a.snapped, b.snapped, a.numerator, b.numerator, a.denominator, b.denominator,
                  a.is_from_lines, b.is_from_lines, a.numerator_at, b.numerator_at,
                  a.denominator_at, b.denominator_at, a.weights, b.weights, a.shares, b.shares,
                  a.is_exact, b.is_exact, a.evaluated, b.evaluated, a.value, b.value);
}

bool is_same(const std::vector<records::TracedValue>& a,
             const std::vector<records::TracedValue>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& one, const auto& other) { return is_same(one, other); });
}

bool is_same(const records::SampleTrace& a, const records::SampleTrace& b) {
  return are_same(a.is_drawn, b.is_drawn, a.positions, b.positions, a.corners, b.corners, a.snapped,
                  b.snapped, a.frame, b.frame, a.lines, b.lines, a.u, b.u, a.v, b.v, a.edges,
                  b.edges, a.decision, b.decision, a.depth, b.depth, a.attributes, b.attributes);
}

bool is_same(const std::array<float, 4>& a, const std::array<float, 4>& b) {
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

template <typename T>
bool is_same(const std::array<T, 3>& a, const std::array<T, 3>& b) {
  return are_same(a[0], b[0], a[1], b[1], a[2], b[2]);
}

template <typename T>
bool is_same(const std::optional<T>& a, const std::optional<T>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return is_same(*a, *b);
}

template <typename T>
bool is_same(const Result<T>& a, const Result<T>& b) {
  if (!a || !b) return !a && !b && to_string(a.error()) == to_string(b.error());
  if constexpr (std::is_void_v<T>) {
    return true;
  } else {
    return is_same(*a, *b);
  }
}

/// The result of draw_over(), and the picture that it leaves.
struct DrawnOver {
  Result<void> result;
  cases::Picture picture;
};

bool is_same(const DrawnOver& a, const DrawnOver& b) {
  return is_same(a.result, b.result) && is_same(a.picture, b.picture);
}

}  // namespace

bool RecordingBackend::is_answered_alike_by(Backend& other) const {
  return std::all_of(questions_.begin(), questions_.end(),
                     [&other](const auto& is_answered_alike) { return is_answered_alike(other); });
}

/// Asks question(backend), records the question with its answer, and returns the answer. The
/// question must own copies of all its other data.
template <typename Question>
auto RecordingBackend::asked(const Question& question) const {
  auto answer = question(*answering_);
  questions_.emplace_back(
      [question, answer](Backend& other) { return is_same(question(other), answer); });
  return answer;
}

backends::About RecordingBackend::about() const {
  return asked([](Backend& backend) { return backend.about(); });
}

cases::Contract RecordingBackend::promise(const cases::Case& c) const {
  return asked([c](Backend& backend) { return backend.contract(c); });
}

backends::PictureDrawer* RecordingBackend::picture_drawer() {
  return asked([](Backend& b) { return b.picture_drawer() != nullptr; }) ? this : nullptr;
}

backends::PictureContinuer* RecordingBackend::picture_continuer() {
  return asked([](Backend& b) { return b.picture_continuer() != nullptr; }) ? this : nullptr;
}

backends::Assembler* RecordingBackend::assembler() {
  return asked([](Backend& b) { return b.assembler() != nullptr; }) ? this : nullptr;
}

backends::VertexStage* RecordingBackend::vertex_stage() {
  return asked([](Backend& b) { return b.vertex_stage() != nullptr; }) ? this : nullptr;
}

backends::Tracer* RecordingBackend::tracer() {
  return asked([](Backend& b) { return b.tracer() != nullptr; }) ? this : nullptr;
}

backends::WaysOfDrawing* RecordingBackend::ways_of_drawing() {
  return asked([](Backend& b) { return b.ways_of_drawing() != nullptr; }) ? this : nullptr;
}

backends::OcclusionCuller* RecordingBackend::occlusion_culler() {
  return asked([](Backend& b) { return b.occlusion_culler() != nullptr; }) ? this : nullptr;
}

Result<bool> RecordingBackend::is_occluded(const cases::Case& c, std::size_t occluders) {
  return asked(
      [c, occluders](Backend& b) { return b.occlusion_culler()->is_occluded(c, occluders); });
}

std::vector<cases::DrawBy> RecordingBackend::ways() const {
  return asked([](Backend& b) { return b.ways_of_drawing()->ways(); });
}

Result<cases::Fragments> RecordingBackend::draw_by(const cases::Case& c, cases::DrawBy way) {
  return asked([c, way](Backend& b) { return b.ways_of_drawing()->draw_by(c, way); });
}

Result<cases::Fragments> RecordingBackend::draw_fragments(const cases::Case& c) {
  return asked([c](Backend& backend) { return backends::fragments_of(backend.draw(c)); });
}

Result<std::optional<records::SampleTrace>> RecordingBackend::trace(const cases::Case& c,
                                                                    const cases::SamplePlace& at) {
  return asked([c, at](Backend& backend) { return backend.tracer()->trace(c, at); });
}

Result<cases::Picture> RecordingBackend::draw_picture(const cases::Case& c,
                                                      const cases::Pipeline& pipeline) {
  return asked([c, pipeline](Backend& backend) {
    return backend.picture_drawer()->draw_picture(c, pipeline);
  });
}

Result<void> RecordingBackend::draw_over(const cases::Case& c, const cases::Pipeline& pipeline,
                                         cases::Picture& picture) {
  DrawnOver drawn = asked([c, pipeline, before = picture](Backend& backend) {
    DrawnOver over{{}, before};
    over.result = backend.picture_continuer()->draw_over(c, pipeline, over.picture);
    return over;
  });
  picture = std::move(drawn.picture);
  return drawn.result;
}

Result<cases::Fragments> RecordingBackend::draw_assembled(const cases::Case& c,
                                                          cases::Topology topology,
                                                          std::span<const std::uint32_t> indices) {
  const std::vector<std::uint32_t> kept(indices.begin(), indices.end());
  return asked([c, topology, kept](Backend& backend) {
    return backend.assembler()->draw_assembled(c, topology, kept);
  });
}

Result<std::vector<cases::ClipVertex>> RecordingBackend::transform(const cases::Case& c) {
  return asked([c](Backend& backend) { return backend.vertex_stage()->transform(c); });
}

Result<std::vector<cases::Normal>> RecordingBackend::transform_normals(
    const cases::Matrix4& model, std::span<const cases::Normal> normals) {
  const std::vector<cases::Normal> kept(normals.begin(), normals.end());
  return asked([model, kept](Backend& backend) {
    return backend.vertex_stage()->transform_normals(model, kept);
  });
}

}  // namespace rastercheck::mutants
