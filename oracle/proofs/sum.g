# D = fl(fl(e0 + e1) + e2) differs from the exact sum of the edge functions by at most `error`.
#
# Code: BatchWeights::error (filter_kernels.h); WeighSamples computes
#
#   bands  = fl(fl(fl(b0 + b1) + b2) (1 + 2^-40))
#   size   = fl(fl(|e0| + |e1|) + |e2|)
#   error  = fl(bands + 4u size)
#
# Assumes: the exact E_i is e_i + b_i r_i, where b_i is the band without a margin and |r_i| <= 1
# (edge.g; TriangleFilter::edges_of returns only edges without a margin); the relative errors of
# roundings.g.
#
# As in edge.g, e_i is its size n_i times a sign, and the bound is shown for one side.
#@ -Eprecision=200
four_u = 4 * 1b-53;
# Refused with: four_u = 2 * 1b-53;
inflation = 1b-40;
# Refused with: inflation = 1b-51;

e0 = n0 * s0;
e1 = n1 * s1;
e2 = n2 * s2;
D = ((e0 + e1) * (1 + d1) + e2) * (1 + d2);
exact = e0 + b0 * r0 + (e1 + b1 * r1) + (e2 + b2 * r2);

bands = ((b0 + b1) * (1 + k1) + b2) * (1 + k2) * (1 + inflation) * (1 + k3);
size = ((n0 + n1) * (1 + k4) + n2) * (1 + k5);
error = (bands + four_u * size) * (1 + k6);

{ d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ k1 in [-1b-53, 1b-53] /\
  k2 in [-1b-53, 1b-53] /\ k3 in [-1b-53, 1b-53] /\ k4 in [-1b-53, 1b-53] /\
  k5 in [-1b-53, 1b-53] /\ k6 in [-1b-53, 1b-53] /\
  n0 in [0, 1b700] /\ n1 in [0, 1b700] /\ n2 in [0, 1b700] /\
  b0 in [0, 1b700] /\ b1 in [0, 1b700] /\ b2 in [0, 1b700] /\
  s0 in [-1, 1] /\ s1 in [-1, 1] /\ s2 in [-1, 1] /\
  r0 in [-1, 1] /\ r1 in [-1, 1] /\ r2 in [-1, 1]
  ->
  error - (D - exact) >= 0 }

error - (D - exact) ->
    b0 * ((1 + k1) * (1 + k2) * (1 + inflation) * (1 + k3) * (1 + k6) + r0)
  + b1 * ((1 + k1) * (1 + k2) * (1 + inflation) * (1 + k3) * (1 + k6) + r1)
  + b2 * ((1 + k2) * (1 + inflation) * (1 + k3) * (1 + k6) + r2)
  + n0 * (four_u * (1 + k4) * (1 + k5) * (1 + k6) - s0 * ((1 + d1) * (1 + d2) - 1))
  + n1 * (four_u * (1 + k4) * (1 + k5) * (1 + k6) - s1 * ((1 + d1) * (1 + d2) - 1))
  + n2 * (four_u * (1 + k5) * (1 + k6) - s2 * d2);
