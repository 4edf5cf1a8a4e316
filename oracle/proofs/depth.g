# [lo, hi] of a depth holds N*/Den*, N the line of the depth's numerators, Den = |det M|.
#
# Of: DepthFilter (depth_filter.cpp):
#
#   reciprocal = fl(1/Den)        radius = fl(fl(2 band) reciprocal)         2 band is exact
#   depth      = fl(e reciprocal)              lo, hi = fl(depth -+ radius)
#
# Assumes: |e - N*| <= band, band = 8u size, where each is computed in a few roundings and |e| <=
# (1 + 2^-40) size (edge.g: the sum of the terms' sizes); Den is within 2^-51 of Den*, relative to
# itself (limbs.g). Nothing underflows: e is 0 or at least 2^-656 (roundings.g), and so is the band, and Den lies
# between 2^-300 and 2^300.
#
# In units of size/Den, which so drops out: e = s, band = w, N* = s + w r with |r| <= 1, and
# Den/Den* = 1 + k. For hi; for lo turn the signs s and r round.

#@ -Eprecision=200
twice = 2;
# Refused with: twice = 1.87;

s = sign * (1 + 1b-40);
w = 8 * 1b-53 * (1 + d5);
hi = (s * ((1 + d1) * (1 + d2)) + twice * w * ((1 + d1) * (1 + d3))) * (1 + d4);
exact = (s + w * r) * (1 + k);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\ d4 in [-1b-53, 1b-53] /\
  |d5| <= 1b-50 /\ |k| <= 1b-51 /\ sign in [-1, 1] /\ r in [-1, 1]
  ->
  hi - exact >= 0 }

hi - exact ->
    s * ((1 + d1) * (1 + d2) * (1 + d4) - (1 + k))
  + w * (twice * ((1 + d1) * (1 + d3) * (1 + d4)) - r * (1 + k));
