# [q - radius, q + radius], rounded to nearest, contains S*/Den*. A star marks an exact number.
#
# Code: value_errors (filter_kernels.h): what ValueErrors computes after its loop,
#
#   R       = fl(1/Den)
#   q       = fl(S R)
#   h       = fl(fl(fl(fl(H + fl(|q| Z)) R) (1 + 2^-18)) + 4u |q|)
#   radius  = fl(h + least),      hi = fl(q + radius)
#
# roundings.g shows that multiplying by `units` is exact; that needs a `least` of this size.
#
# Assumes: Den > 0; |Den - Den*| <= Z <= 2^-20 Den (sum.g, and the test beside `reciprocal`; for a
# determinant limbs.g, with Z = 2^-51 Den); |S - S*| <= H (value.g); H > 0, so that `least` is
# added. H is 0 only if all g_i are 0; everything is then 0 and exact. Quotients of sums without an
# error are computed in another way (filter_kernels.h).
#
# Numbers are in units of Den, so its size drops out: N = |S|/Den, eta = H/Den, z = Z/Den.
# S* = S + H r with |r| <= 1, and Den/Den* = 1 + z y with |y| <= 1/(1 - 2^-20). s is the sign of S,
# hence of q. Shown for hi; lo follows with the signs s and r reversed.
#
# Underflow. A product here may be subnormal: fl(v w) = v w (1 + d) + t, |t| <= 2^-1074. Only the
# product |q| Z is multiplied again, by R, which may be large. t3 is the t of that product divided
# by Den, and is no larger than 2^-1074 either: Let S not be 0, hence at least 2^-955 (roundings.g),
# and Z not be 0, hence at least u Den. If |S|/Den >= 2^-1021, then |q| Z >= |S| u/2 is normal, and
# t3 = 0. Otherwise Den > 2^66, and R is small. R itself is normal, because Den lies between 2^-656
# and 2^620 or, if it is a determinant, between 2^-900 and 2^900.
#@ -Eprecision=200
four_u = 4 * 1b-53;
# Refused with: four_u = 3 * 1b-53;
share = 1b-18;
# Refused with: share = 1b-20;
least = 1b-900;
# Refused with: least = 5 * 1b-1074;

T = (1 + d1) * (1 + d2);
m = N * T + t1;                               # |q|
absolute = (eta + (m * z * (1 + d3) + t3)) * ((1 + d4) * (1 + d1) * (1 + d5)) + t5;
h = (absolute * ((1 + share) * (1 + d6)) + t6 + (four_u * m + t7)) * (1 + d7);
hi = (s * m + (h + least) * (1 + d8)) * (1 + d9);
exact = (s * N + eta * r) * (1 + z * y);

X = (1 + d4) * (1 + d1) * (1 + d5) * ((1 + share) * (1 + d6));
Y = (1 + d7) * (1 + d8) * (1 + d9);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\
  d4 in [-1b-53, 1b-53] /\ d5 in [-1b-53, 1b-53] /\ d6 in [-1b-53, 1b-53] /\
  d7 in [-1b-53, 1b-53] /\ d8 in [-1b-53, 1b-53] /\ d9 in [-1b-53, 1b-53] /\
  |t1| <= 1b-1074 /\ |t3| <= 1b-1074 /\ |t5| <= 1b-1074 /\ |t6| <= 1b-1074 /\ |t7| <= 1b-1074 /\
  N in [0, 1b2000] /\ eta in [0, 1b2000] /\ z in [0, 1b-20] /\
  s in [-1, 1] /\ r in [-1, 1] /\ |y| <= 1.00000095368
  ->
  hi - exact >= 0 }

hi - exact ->
    N * (s * (T * (1 + d9) - 1) + four_u * T * Y + z * ((1 + d3) * X * T * Y - s * y))
  + eta * (X * Y - r * (1 + z * y))
  + (least * ((1 + d8) * (1 + d9))
     + (t1 * (s * (1 + d9) + (z * (1 + d3) * X + four_u) * Y)
        + (t3 * X + t5 * ((1 + share) * (1 + d6)) + t6 + t7) * Y));
