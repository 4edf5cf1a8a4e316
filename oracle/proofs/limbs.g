# near_double() differs from its value by at most 2^-51 of the value, and by at most 2^-51 of the
# double.
#
# Code: near_double (number.h), which is CGAL's Mpzf::to_double(). The number is top + next + rest,
# times a power of two, in limbs of 64 bits: `top` is the first limb, an integer that is not 0, and
# `next` is the next limb times 2^-64. to_double() computes
#
#   fl(top)                      if top >= 2^53: the part left out is less than 1, at most u top
#   fl(top + fl(next))           otherwise: the part left out is less than 2^-64, at most u top
#
# Assumes: the result is a normal double, so that multiplying by the power of two does not round;
# filter_line and set_filter accept no other results.
#
# The first form is the second with next = 0. The value is assumed not to be negative; s is the sign
# of the difference. As in all scripts, the hints group terms by size, so that the factor of each
# size is at least 0.
#@ -Eprecision=200
most = 1b-51;
# Refused with: most = 2 * 1b-53;

double = (top + next * (1 + d1)) * (1 + d2);
value = top + next + top * left_out;

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\
  top in [0, 1b64] /\ next in [0, 1] /\ left_out in [0, 1b-53] /\ s in [-1, 1]
  ->
  most * value - s * (double - value) >= 0 /\
  most * double - s * (double - value) >= 0 }

most * value - s * (double - value) ->
    top * (most * (1 + left_out) - s * (d2 - left_out))
  + next * (most - s * ((1 + d1) * (1 + d2) - 1));
most * double - s * (double - value) ->
    top * (most * (1 + d2) - s * (d2 - left_out))
  + next * (most * ((1 + d1) * (1 + d2)) - s * ((1 + d1) * (1 + d2) - 1));
