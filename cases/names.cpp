#include "cases/names.h"

#include <array>

namespace rastercheck::cases {
namespace {

template <typename Enum, std::size_t N>
using Table = std::array<std::pair<std::string_view, Enum>, N>;

constexpr Table<Rules, 3> kRules{
    {{"opengl", Rules::opengl}, {"vulkan", Rules::vulkan}, {"d3d", Rules::d3d}}};
constexpr Table<Cull, 3> kCull{
    {{"none", Cull::none}, {"back", Cull::back}, {"front", Cull::front}}};
constexpr Table<FrontFace, 2> kFrontFace{{{"ccw", FrontFace::ccw}, {"cw", FrontFace::cw}}};
constexpr Table<Interpolation, 3> kInterpolation{{{"smooth", Interpolation::smooth},
                                                  {"noperspective", Interpolation::noperspective},
                                                  {"flat", Interpolation::flat}}};
constexpr Table<Location, 3> kLocation{
    {{"sample", Location::sample}, {"center", Location::center}, {"centroid", Location::centroid}}};
constexpr Table<DepthTest, 2> kDepthTest{{{"none", DepthTest::none}, {"less", DepthTest::less}}};
constexpr Table<Rounding, 3> kRounding{{{"nearest_even", Rounding::nearest_even},
                                        {"half_up", Rounding::half_up},
                                        {"unspecified", Rounding::unspecified}}};
constexpr Table<Basis, 3> kBasis{
    {{"ideal", Basis::ideal}, {"snapped", Basis::snapped}, {"unspecified", Basis::unspecified}}};
// `unspecified` is a contract's word, not a case file's.
constexpr Table<TieRule, 2> kTieRule{
    {{"top_left", TieRule::top_left}, {"bottom_left", TieRule::bottom_left}}};

}  // namespace

template <>
NameTable<Rules> names() {
  return kRules;
}
template <>
NameTable<Cull> names() {
  return kCull;
}
template <>
NameTable<FrontFace> names() {
  return kFrontFace;
}
template <>
NameTable<Interpolation> names() {
  return kInterpolation;
}
template <>
NameTable<Location> names() {
  return kLocation;
}
template <>
NameTable<DepthTest> names() {
  return kDepthTest;
}
template <>
NameTable<Rounding> names() {
  return kRounding;
}
template <>
NameTable<Basis> names() {
  return kBasis;
}
template <>
NameTable<TieRule> names() {
  return kTieRule;
}

}  // namespace rastercheck::cases
