#include "cases/contract_terms.h"

namespace rastercheck::cases {
namespace {

template <typename Named, typename Promise>
void keep(const std::optional<Named>& term, Promise& own) {
  if (term) own = *term;
}

template <typename Promise>
void keep(const Term<Promise>& term, const Promise& asked, Promise& own) {
  if (!term) return;
  const auto* named = std::get_if<Promise>(&*term);
  own = named == nullptr ? asked : *named;
}

/// Terms also replace a backend's promises about single triangles.
void keep(const ContractTerms& terms, const Coverage& coverage, TrianglePromise& own) {
  if (terms.coverage) own.position_error = coverage ? coverage->position_error : 0;
  keep(terms.clip_tolerance, own.clip_tolerance);
  keep(terms.clip_error, own.clip_error);
  keep(terms.smooth, own.bounds.smooth);
  keep(terms.noperspective, own.bounds.noperspective);
  keep(terms.depth, own.bounds.depth);
}

Coverage coverage_of(const CoverageTerm& term, const Contract& own, const Case& c) {
  if (!term) return own.coverage;
  if (const auto* named = std::get_if<Coverage>(&*term)) return *named;
  const auto* grid = std::get_if<AskedGrid>(&*term);
  if (grid == nullptr || !c.coverage) return c.coverage;
  Snapping snapping = *c.coverage;
  snapping.rounding = grid->rounding;
  snapping.rounding_of_y = grid->rounding_of_y;
  snapping.position_error = grid->position_error;
  return snapping;
}

}  // namespace

Contract with_terms(Contract own, const ContractTerms& terms, const Case& c) {
  own.coverage = coverage_of(terms.coverage, own, c);
  keep(terms.is_on_grid, own.is_on_grid);
  keep(terms.basis, c.basis, own.basis);
  if (!own.coverage) own.basis = Basis::ideal;  // there are no snapped positions
  keep(terms.tie_rule, c.fill_rule, own.tie_rule);
  keep(terms.conservative, own.conservative);
  keep(terms.guard_band, own.guard_band);
  if (terms.guard_band) own.guard_beyond_viewport.reset();
  if (terms.guard_beyond_viewport) own.guard_beyond_viewport = terms.guard_beyond_viewport;
  keep(terms.culls_instead_of_clipping, own.culls_instead_of_clipping);
  keep(terms.culls, own.culls);
  keep(terms.least_area, own.least_area);
  if (terms.sample_position) own.sample_position = terms.sample_position;
  keep(terms.clip_tolerance, own.clip_tolerance);
  keep(terms.clip_error, own.clip_error);
  keep(terms.viewport_error, own.viewport_error);
  if (c.depth_format == DepthFormat::float32) keep(terms.depth_format, own.depth_format);
  keep(terms.depth_store, own.depth_store);
  keep(terms.depth_bias, own.depth_bias);
  keep(terms.depth_function, own.depth_function);
  keep(terms.depth_error, own.depth_error);
  keep(terms.claims, own.claims);
  keep(terms.smooth, own.bounds.smooth);
  keep(terms.noperspective, own.bounds.noperspective);
  keep(terms.depth, own.bounds.depth);
  keep(terms.keeps_equal_depth, own.keeps_equal_depth);
  keep(terms.keeps_constants, own.keeps_constants);
  keep(terms.keeps_vertex_values, own.keeps_vertex_values);
  keep(terms.keeps_sign_of_zero, own.keeps_sign_of_zero);
  keep(terms.is_invariant, own.is_invariant);
  keep(terms.derivative_bound, own.derivative_bound);
  keep(terms.quad_share, own.quad_share);
  keep(terms.numbers, own.numbers);
  for (TrianglePromise& of_triangle : own.triangles) keep(terms, own.coverage, of_triangle);
  return own;
}

}  // namespace rastercheck::cases
