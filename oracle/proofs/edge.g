# An edge function in doubles differs from the exact one by at most `band`. If a margin is added,
# the wider band is at least the sum of band and margin.
#
# Code: FilterLine (filter_kernels.h). filter_line and TriangleFilter's constructor
# (triangle_filter.cpp) compute the band:
#
#   size    = fl(fl(fl(|a| W) + fl(|b| H)) + |c|)
#   band    = (2^-51 + 2^-51) size                       exact
#   wide    = fl(fl(band + margin) (1 + 2^-50))
#
# ClassifyRow and `edge_at` in WeighSamples compute fl(fl(a x) + fl(fl(b y) + c)).
#
# Assumes: each exact coefficient differs from a, b or c by at most 2^-51 of that double (limbs.g),
# and is 0 if the double is 0 (filter_line); x in [0, W], y in [0, H] (samples of the box that the
# line was made for); the relative errors of roundings.g. `margin` is any double, at least 0. A
# subnormal `wide` is also at least `margin`, because the band is then 0 and rounding is monotone.
#
# Sizes are sa = |a| W, sb = |b| H, sc = |c|. The terms a x, b y and c are s1, s2 and s3 times these
# sizes; each of these factors combines a sign with a share. The bound is shown for one side; the
# other side follows with all signs reversed, because rounding is symmetric.
#@ -Eprecision=200
share = 8 * 1b-53;  # 2^-51 for the coefficients, 2^-51 for rounding
# Refused with: share = 7 * 1b-53;
widening = 1b-50;
# Refused with: widening = 2 * 1b-53;

ax = sa * s1;
by = sb * s2;
c = sc * s3;
e = (ax * (1 + d1) + (by * (1 + d2) + c) * (1 + d3)) * (1 + d4);
exact = ax * (1 + ra) + by * (1 + rb) + c * (1 + rc);

size = ((sa * (1 + k1) + sb * (1 + k2)) * (1 + k3) + sc) * (1 + k4);
band = share * size;
wide = (any_band + margin) * (1 + k5) * (1 + widening) * (1 + k6);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\
  d4 in [-1b-53, 1b-53] /\ k1 in [-1b-53, 1b-53] /\ k2 in [-1b-53, 1b-53] /\
  k3 in [-1b-53, 1b-53] /\ k4 in [-1b-53, 1b-53] /\ k5 in [-1b-53, 1b-53] /\
  k6 in [-1b-53, 1b-53] /\
  ra in [-1b-51, 1b-51] /\ rb in [-1b-51, 1b-51] /\ rc in [-1b-51, 1b-51] /\
  sa in [0, 1b700] /\ sb in [0, 1b700] /\ sc in [0, 1b700] /\
  s1 in [-1, 1] /\ s2 in [-1, 1] /\ s3 in [-1, 1] /\
  any_band in [0, 1b700] /\ margin in [0, 1b1024]
  ->
  band - (e - exact) >= 0 /\
  wide - (any_band + margin) >= 0 }

band - (e - exact) ->
    sa * (share * ((1 + k1) * (1 + k3) * (1 + k4))
          - s1 * ((1 + d1) * (1 + d4) - 1 - ra))
  + sb * (share * ((1 + k2) * (1 + k3) * (1 + k4))
          - s2 * ((1 + d2) * (1 + d3) * (1 + d4) - 1 - rb))
  + sc * (share * (1 + k4) - s3 * ((1 + d3) * (1 + d4) - 1 - rc));
wide - (any_band + margin) ->
  (any_band + margin) * ((1 + k5) * (1 + widening) * (1 + k6) - 1);
