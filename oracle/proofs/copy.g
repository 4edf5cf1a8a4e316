# [lo, hi] of a flat value contains f - s.
#
# Code: filter_column for ValueMethod::copy (value_cascade.cpp), which computes
#
#   d = fl(f - s)       slack = 8u |d|, exact       lo, hi = fl(d -+ slack)
#
# Assumes: the relative errors of roundings.g, which also shows that multiplying by `units` is
# exact.
#
# Shown for f - s >= 0; the other case follows with both signs reversed, which exchanges lo and hi.
# `difference` may be arbitrarily small; if it is 0, both ends are 0.
#@ -Eprecision=200
eight_u = 8 * 1b-53;
# Refused with: eight_u = 2 * 1b-53;

d = difference * (1 + d1);
lo = d * (1 - eight_u) * (1 + d2);
hi = d * (1 + eight_u) * (1 + d3);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\
  difference in [0, 1b130]
  ->
  difference - lo >= 0 /\ hi - difference >= 0 }

difference - lo -> difference * (1 - (1 + d1) * (1 - eight_u) * (1 + d2));
hi - difference -> difference * ((1 + d1) * (1 + eight_u) * (1 + d3) - 1);
