#include "properties/campaign/internal/hints.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "cases/fragments.h"
#include "cases/some_fragments.h"
#include "oracle/judge.h"
#include "oracle/transform.h"
#include "oracle/triangle_truth.h"
#include "properties/campaign/internal/simple_changes.h"
#include "properties/drawing.h"
#include "properties/random_state.h"

namespace rastercheck::properties {
namespace {

using cases::Fragments;
using records::DrawnPart;
using records::FragmentClass;

/// The wrong parts of a drawing, and where it is wrong.
struct Wrong {
  WrongParts parts;
  std::vector<cases::SamplePlace> places;  ///< the first and the last wrong sample
  std::set<FragmentClass> classes;         ///< how coverage is wrong
};

/// Judges the given parts of a drawing against a case.
class Judging {
 public:
  explicit Judging(const DrawnParts& parts) : parts_(&parts) {}

  Wrong wrong(const cases::Case& c, const cases::Contract& contract, const Fragments& drawn) const {
    Wrong wrong;
    const oracle::SceneTruth scene(c, contract);
    oracle::JudgeOptions options;
    options.judges_values =
        parts_->contains(DrawnPart::depth) || parts_->contains(DrawnPart::values);
    options.self_check_one_in = 0;
    options.shows_ordinary = false;
    oracle::judge(scene, drawn, options,
                  [&](const oracle::JudgedSample& sample, const oracle::TriangleTruth* /*truth*/) {
                    take(sample, wrong);
                  });
    return wrong;
  }

  bool is_right(const cases::Case& c, const cases::Contract& contract,
                const Fragments& drawn) const {
    // Coverage and a few values take the least time to judge, and mostly suffice to find an error.
    if (parts_->size() > 1 && parts_->contains(DrawnPart::coverage)) {
      const DrawnParts coverage{DrawnPart::coverage};
      if (!Judging(coverage).is_right(c, contract, drawn)) return false;
    }
    if (parts_->contains(DrawnPart::depth) || parts_->contains(DrawnPart::values)) {
      constexpr std::size_t kFew = 16;
      DrawnParts of_values = *parts_;
      of_values.erase(DrawnPart::coverage);
      const Fragments few = cases::thinned(drawn, kFew);
      if (!Judging(of_values).wrong(c, contract, few).parts.is_none()) return false;
    }
    return wrong(c, contract, drawn).parts.is_none();
  }

  /// Judges one pixel of a drawing only.
  bool is_right_in_pixel(cases::Case c, const cases::Contract& contract, const Fragments& drawn,
                         const cases::SamplePlace& place) const {
    std::vector<std::size_t> in_pixel;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn.x[i] == place.x && drawn.y[i] == place.y) in_pixel.push_back(i);
    }
    const cases::Scissor pixel{static_cast<int>(place.x), static_cast<int>(place.y), 1, 1};
    if (c.scissor && !is_inside(pixel, *c.scissor)) return in_pixel.empty();
    c.scissor = pixel;
    return wrong(c, contract, cases::some_fragments(drawn, in_pixel)).parts.is_none();
  }

 private:
  static bool is_inside(const cases::Scissor& pixel, const cases::Scissor& s) {
    return pixel.x >= s.x && pixel.x < s.x + s.width && pixel.y >= s.y && pixel.y < s.y + s.height;
  }

  void take(const oracle::JudgedSample& sample, Wrong& wrong) const {
    WrongParts of_sample;
    const bool is_right = sample.fragment_class == FragmentClass::correct;
    if (!is_right && parts_->contains(DrawnPart::coverage)) {
      of_sample.coverage = true;
      wrong.classes.insert(sample.fragment_class);
    }
    for (const oracle::JudgedValue& value : sample.values) {
      if (value.fragment_class == FragmentClass::correct) continue;
      if (!parts_->contains(part_of(value.kind))) continue;
      if (value.attribute) {
        of_sample.attributes.insert(*value.attribute);
      } else {
        of_sample.depth = true;
      }
    }
    if (of_sample.is_none()) return;
    wrong.parts.coverage |= of_sample.coverage;
    wrong.parts.depth |= of_sample.depth;
    wrong.parts.attributes.merge(of_sample.attributes);
    if (wrong.places.size() == 2) wrong.places.pop_back();
    wrong.places.push_back(sample.place);
  }

  const DrawnParts* parts_;
};

/// Returns the drawn fragments moved to their places in the changed case.
Fragments at_its_places(const SimpleChange& change, Fragments drawn) {
  if (change.place_of == nullptr) return drawn;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const cases::SamplePlace place = change.place_of(change.source.framebuffer, drawn.place_of(i));
    drawn.x[i] = static_cast<std::uint16_t>(place.x);
    drawn.y[i] = static_cast<std::uint16_t>(place.y);
    drawn.sample[i] = static_cast<std::uint8_t>(place.sample);
  }
  return drawn;
}

cases::TieRule other_tie_rule(cases::TieRule rule) {
  const bool is_top = rule == cases::TieRule::top_left;
  return is_top ? cases::TieRule::bottom_left : cases::TieRule::top_left;
}

cases::Contract contract_of(const SimpleChange& change, const backends::Backend& backend,
                            cases::TieRule tie_rule) {
  cases::Contract contract = backend.contract(change.source);
  if (change.names_grid) {
    contract.coverage = change.source.coverage;
    const bool is_open = contract.coverage && contract.basis == cases::Basis::unspecified;
    if (!is_open) contract.basis = change.source.basis;
    // The promised error is in units of the contract's grid, so it means nothing on the case's
    // grid.
    for (cases::TrianglePromise& promise : contract.triangles) promise.position_error = 0;
  }
  if (change.swaps_ties && tie_rule != cases::TieRule::unspecified) {
    contract.tie_rule = other_tie_rule(tie_rule);
  }
  return contract;
}

/// Returns the clause of a rasterizer that draws all samples on edges, or none. Such a drawing has
/// samples too many by either tie rule, or too few by either, and is right if ties are left open.
std::optional<std::string> hint_of_ties(const cases::ClipCase& c, const cases::Contract& contract,
                                        const Fragments& drawn) {
  if (contract.tie_rule == cases::TieRule::unspecified) return std::nullopt;
  const DrawnParts parts{DrawnPart::coverage};
  const Judging judging(parts);
  cases::Contract other = contract;
  other.tie_rule = other_tie_rule(contract.tie_rule);
  const std::set<FragmentClass> classes = judging.wrong(c, contract, drawn).classes;
  if (classes.size() != 1 || judging.wrong(c, other, drawn).classes != classes) return std::nullopt;
  other.tie_rule = cases::TieRule::unspecified;
  if (!judging.is_right(c, other, drawn)) return std::nullopt;
  if (classes.contains(FragmentClass::extra)) return "every triangle owns the samples on its edges";
  if (classes.contains(FragmentClass::missing)) return "no triangle owns the samples on its edges";
  return std::nullopt;
}

/// Returns the case with the window depths of its vertices as its only attribute, smooth. Returns
/// nothing if depth depends on more than these, or if a vertex has no window depth.
std::optional<cases::Case> with_depths_as_values(const cases::Case& c) {
  const bool is_plain = c.depth_bias == cases::DepthBias{} && !c.depth_clamp &&
                        c.depth_format == cases::DepthFormat::float32;
  if (!is_plain || c.positions.empty()) return std::nullopt;
  cases::Case changed = c;
  changed.attributes = {{"depth"}};
  changed.attribute_values.clear();
  const double near = near_depth(c);
  const cases::Viewport& v = c.viewport;
  for (const cases::ClipVertex& p : c.positions) {
    if (!(p.w > 0)) return std::nullopt;
    const double share = (double{p.z} / double{p.w} - near) / (1 - near);
    const double depth = v.min_depth + share * (double{v.max_depth} - double{v.min_depth});
    changed.attribute_values.push_back(static_cast<float>(depth));
  }
  return changed;
}

/// Returns a drawing whose only attribute is the depth of another one.
Fragments with_depth_as_value(Fragments drawn) {
  drawn.attribute_count = 1;
  drawn.attributes = drawn.depth;
  drawn.derivatives.clear();
  return drawn;
}

/// Returns the clause of a rasterizer that divides depth by interpolated 1/w, as it does smooth
/// attributes, although z/w is affine on the screen. `right` is the drawing with depth corrected.
std::optional<std::string> hint_of_depth(const cases::Case& c, const backends::Backend& backend,
                                         const Fragments& drawn, const Fragments& right) {
  const std::optional<cases::Case> changed = with_depths_as_values(c);
  if (!changed) return std::nullopt;
  cases::Contract contract = backend.contract(*changed);
  // The vertices' depths are rounded: up to three times in the rasterizer (quotient, product, sum)
  // and once above, each by half a unit.
  constexpr float kRoundings = 2;
  cases::ValueBound& bound = contract.bounds.smooth;
  bound.constant = std::max(bound.constant, contract.bounds.depth.constant) + kRoundings;
  const DrawnParts parts{DrawnPart::values};
  const auto is_right = [&](const Fragments& fragments) {
    return Judging(parts).is_right(*changed, contract, with_depth_as_value(fragments));
  };
  if (!is_right(drawn) || is_right(right)) return std::nullopt;
  return "depth is interpolated with perspective";
}

}  // namespace

std::optional<std::vector<std::string>> hints_of(const cases::Case& source,
                                                 backends::Backend& backend,
                                                 const DrawnParts& parts,
                                                 const IsToEnd& is_to_end) {
  const Result<cases::ClipCase> c = oracle::to_clip_case(source, "");
  if (!c) return std::nullopt;
  const Result<backends::Drawn> drawn = draw(*c, backend);
  if (!drawn) return std::nullopt;
  const Wrong wrong = Judging(parts).wrong(*c, drawn->contract, drawn->fragments);
  if (wrong.parts.is_none()) return std::nullopt;
  // Changes that look alike in these parts may differ in the whole drawing.
  const DrawnParts whole{DrawnPart::coverage, DrawnPart::depth, DrawnPart::values};
  const auto put_right_in = [&](const DrawnParts& some) {
    Fragments right = drawn->fragments;
    put_right(*c, drawn->contract, some, right);
    return right;
  };
  const Fragments right = put_right_in(parts);
  const Fragments wholly_right = parts == whole ? right : put_right_in(whole);
  std::vector<std::string> hints;
  if (wrong.parts.coverage) {
    if (auto hint = hint_of_ties(*c, drawn->contract, drawn->fragments)) hints.push_back(*hint);
  }
  if (wrong.parts.depth && !wrong.parts.coverage && wrong.parts.attributes.empty()) {
    if (auto hint = hint_of_depth(*c, backend, drawn->fragments, right)) hints.push_back(*hint);
  }
  visit_simple_changes(*c, wrong.parts, [&](const SimpleChange& change) {
    const bool is_there = std::find(hints.begin(), hints.end(), change.change) != hints.end();
    if (is_there || (is_to_end && is_to_end())) return;
    const cases::Contract contract = contract_of(change, backend, drawn->contract.tie_rule);
    // A change that explains the drawing makes each wrong pixel right. Nearly all changes fail this
    // test, which takes far less time than judging the whole drawing.
    const Fragments moved = at_its_places(change, drawn->fragments);
    for (const cases::SamplePlace& place : wrong.places) {
      const cases::SamplePlace there =
          change.place_of ? change.place_of(change.source.framebuffer, place) : place;
      if (!Judging(parts).is_right_in_pixel(change.source, contract, moved, there)) return;
    }
    const auto explains = [&](const DrawnParts& some, const Fragments& right_in_these) {
      const auto is_right = [&](const Fragments& fragments) {
        return Judging(some).is_right(change.source, contract, at_its_places(change, fragments));
      };
      return is_right(drawn->fragments) && !is_right(right_in_these);
    };
    const bool is_hint =
        explains(parts, right) || (parts != whole && explains(whole, wholly_right));
    if (is_hint) hints.push_back(change.change);
  });
  return hints;
}

}  // namespace rastercheck::properties
