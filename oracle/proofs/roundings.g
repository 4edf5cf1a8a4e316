# Every rounding that the other scripts assume to be relative is relative, because nothing is lost
# to underflow: fl(z) = z (1 + d), |d| <= u = 2^-53. Every product that they assume to be exact is
# exact.
#
# Code: filter_line (triangle_filter.cpp); in filter_kernels.cpp ClassifyRow, WeighSamples, and
# ValueErrors up to `sum_error` and where it multiplies by `units`; ValueMethod::copy in
# filter_column (value_cascade.cpp).
#
# FIX(z, k) says that z is a multiple of 2^k. fl(z) is then a multiple of 2^k, too. If k >= -1074,
# the exponent of the least subnormal, fl(z) is off by at most u |z|, however small z is. A double
# times a power of two is exact if the product is a multiple of 2^-1074. Sums of multiples of a
# power are multiples of that power, so it is enough to show one operation of each kind.
#
# Assumes:
#
#   a, b, c       0, or from 2^-600 to 2^600 (fits_filter): multiples of 2^-652
#   x, y, W, H    multiples of 1/16, at most 2^15 (cases::kMaxSize is 2^14; cases::SamplePosition)
#   f, t, p, s    float32: multiples of 2^-149, below 2^128. Because p = 1 or t = 1, g is either
#                 (f - s) t, or f p - s' with a double s' that is a multiple of 2^-299 (half a
#                 product of two float32 at the least; Scene::depth_numerator without a camera)
#   units         a power of two, at least 2^-104 (units_of)
#
# Doubles are assumed here to have no greatest number. By the bounds at the end, no edge function
# comes near the real greatest double, nor, because |g| < 2^258, does a product of g and an edge
# function or a sum of three such products. Later operations of ValueErrors may overflow. An end of
# the enclosure is then infinite or NaN, which keeps no limit.
#@ -Eprecision=200
@rnd = float<ieee_64, ne>;
least = 1b-900;
# Refused with: least = 1b-917;

a = rnd(a_); b = rnd(b_); c = rnd(c_);
ax rnd= a * x;
by rnd= b * y;
row rnd= by + c;
e rnd= ax + row;

sa = |a|; sb = |b|; sc = |c|;
saW rnd= sa * W;
sbH rnd= sb * H;
two rnd= saW + sbH;
size rnd= two + sc;
band = 1b-50 * size;
edge_error rnd= band * (1 + 1b-40);
eight_u_e = 1b-50 * e;
e_error rnd= edge_error + eight_u_e;
four_u_e = 1b-51 * e;
certain_e = 1b-20 * e;

difference rnd= f - s;
attribute rnd= difference * t;
depth rnd= f * p - s_depth;
product_attribute rnd= attribute * e;
product_depth rnd= depth * e;
error_attribute rnd= attribute * e_error;
error_depth rnd= depth * e_error;

slack = 1b-50 * difference;
copied rnd= difference + slack;

q = rnd(q_);
h = rnd(h_);
radius rnd= h + least;
end rnd= q + radius;

{
  @FIX(a, -652) /\ @FIX(b, -652) /\ @FIX(c, -652) /\
  # Refused with: @FIX(a, -686) /\ @FIX(b, -686) /\ @FIX(c, -686) /\
  |a| <= 1b600 /\ |b| <= 1b600 /\ |c| <= 1b600 /\
  @FIX(x, -4) /\ x in [0, 1b15] /\ @FIX(y, -4) /\ y in [0, 1b15] /\ @FIX(W, 0) /\ @FIX(H, 0) /\
  @FIX(f, -149) /\ @FIX(s, -149) /\ @FIX(t, -149) /\ @FIX(p, -149) /\ @FIX(s_depth, -299) /\
  @FLT(f, 24) /\ @FLT(p, 24) /\
  h in [0, 1b2000] /\ |q| <= 1b2000
  ->
  ax -/ (a * x) in [-1b-53, 1b-53] /\ by -/ (b * y) in [-1b-53, 1b-53] /\
  row -/ (by + c) in [-1b-53, 1b-53] /\ e -/ (ax + row) in [-1b-53, 1b-53] /\
  saW -/ (sa * W) in [-1b-53, 1b-53] /\ sbH -/ (sb * H) in [-1b-53, 1b-53] /\
  two -/ (saW + sbH) in [-1b-53, 1b-53] /\ size -/ (two + sc) in [-1b-53, 1b-53] /\
  @FIX(band, -1074) /\
  edge_error -/ (band * (1 + 1b-40)) in [-1b-53, 1b-53] /\
  @FIX(eight_u_e, -1074) /\ @FIX(four_u_e, -1074) /\ @FIX(certain_e, -1074) /\
  e_error -/ (edge_error + eight_u_e) in [-1b-53, 1b-53] /\

  difference -/ (f - s) in [-1b-53, 1b-53] /\
  attribute -/ (difference * t) in [-1b-53, 1b-53] /\
  rnd(f * p) - f * p in [0, 0] /\
  depth -/ (f * p - s_depth) in [-1b-53, 1b-53] /\
  product_attribute -/ (attribute * e) in [-1b-53, 1b-53] /\
  product_depth -/ (depth * e) in [-1b-53, 1b-53] /\
  error_attribute -/ (attribute * e_error) in [-1b-53, 1b-53] /\
  error_depth -/ (depth * e_error) in [-1b-53, 1b-53] /\

  @FIX(slack, -1074) /\ copied -/ (difference + slack) in [-1b-53, 1b-53] /\
  @FIX(copied * 1b-104, -1074) /\

  @FIX(end * 1b-104, -1074) /\

  # What quotient.g counts on, and the bounds against overflow.
  @FIX(product_attribute, -955) /\ @FIX(product_depth, -955) /\
  @FIX(e, -656) /\ |e| <= 1b618 }

$ q in (-1b-902, 1b-902);
