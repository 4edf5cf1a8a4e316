# If Line::certain_side (line.cpp) answers, the line's exact value has the same sign as in doubles,
# and is farther from 0 than it can change while the point moves.
#
# What is computed, with a, b, c, u, v and r for the doubles near coefficients, point and reach:
#
#   value  = fl(fl(fl(a u) + fl(b v)) + c)
#   sizes  = fl(fl(fl(|a u|) + fl(|b v|)) + |c|)
#   change = fl(r fl(|a| + |b|))
#   least  = fl(change + fl(sizes + change) 2^-47)
#
# An answer is given if |value| > least. So |exact value| > exact change follows from
# least >= |value - exact value| + exact change.
#
# Assumes: no overflow or underflow (has_normal_products). Roundings may have any direction and are
# at most 2^-52 each. near_double() may then be off by twice the bound that limbs.g proves for
# rounding to nearest: 2^-50 of a coefficient. u and v are quotients of two such numbers
# (near_point), and are off by at most 2^-48. The change is made of three such numbers and two
# roundings, and is off by at most 2^-48 as well.
#
# Sizes are sa = |a u|, sb = |b v|, sc = |c| and ch, the exact change; s1, s2, s3 are signs. The
# bound is shown for one side; the other side follows with all signs reversed.
#@ -Eprecision=200
share = 1b-47;
# Refused with: share = 1b-48;

ta = sa * (1 + ra) * (1 + ru) * (1 + d1);
tb = sb * (1 + rb) * (1 + rv) * (1 + d2);
tc = sc * (1 + rc);
value = ((ta * s1 + tb * s2) * (1 + d3) + tc * s3) * (1 + d4);
exact = sa * s1 + sb * s2 + sc * s3;
sizes = ((ta + tb) * (1 + k1) + tc) * (1 + k2);
change = ch * (1 + rr);
least = (change + (sizes + change) * (1 + k3) * share) * (1 + k4);

{ d1 in [-1b-52, 1b-52] /\ d2 in [-1b-52, 1b-52] /\ d3 in [-1b-52, 1b-52] /\
  d4 in [-1b-52, 1b-52] /\ k1 in [-1b-52, 1b-52] /\ k2 in [-1b-52, 1b-52] /\
  k3 in [-1b-52, 1b-52] /\ k4 in [-1b-52, 1b-52] /\
  ra in [-1b-50, 1b-50] /\ rb in [-1b-50, 1b-50] /\ rc in [-1b-50, 1b-50] /\
  ru in [-1b-48, 1b-48] /\ rv in [-1b-48, 1b-48] /\ rr in [-1b-48, 1b-48] /\
  sa in [0, 1b960] /\ sb in [0, 1b960] /\ sc in [0, 1b960] /\ ch in [0, 1b960] /\
  s1 in [-1, 1] /\ s2 in [-1, 1] /\ s3 in [-1, 1]
  ->
  least - (value - exact) - ch >= 0 }

least - (value - exact) - ch ->
    sa * (share * ((1 + ra) * (1 + ru) * (1 + d1) * (1 + k1) * (1 + k2) * (1 + k3) * (1 + k4))
          - s1 * ((1 + ra) * (1 + ru) * (1 + d1) * (1 + d3) * (1 + d4) - 1))
  + sb * (share * ((1 + rb) * (1 + rv) * (1 + d2) * (1 + k1) * (1 + k2) * (1 + k3) * (1 + k4))
          - s2 * ((1 + rb) * (1 + rv) * (1 + d2) * (1 + d3) * (1 + d4) - 1))
  + sc * (share * ((1 + rc) * (1 + k2) * (1 + k3) * (1 + k4)) - s3 * ((1 + rc) * (1 + d4) - 1))
  + ch * ((1 + rr) * (1 + share * (1 + k3)) * (1 + k4) - 1);
