# S = fl(Σ g_i e_i) differs from Σ g*_i E_i, the exact numerator of a value's error, by at most H. A
# star marks an exact number.
#
# Code: value_errors (filter_kernels.h): what ValueErrors computes in its loop over i,
#
#   g_i  = fl(fl(f p_i - s_i) t_i)                    f p_i is exact
#   S    = fl(fl(fl(g_0 e_0) + fl(g_1 e_1)) + fl(g_2 e_2))        the loop's first sum, 0 + z, is z
#   x_i  = fl(edge_error_i + 8u |e_i|)                edge_error_i = fl(band_i (1 + 2^-40))
#   H    = fl(fl(fl(|g_0| x_0) + fl(|g_1| x_1)) + fl(|g_2| x_2))
#
# Assumes: the exact E_i is e_i + b_i r_i, where b_i is the band and |r_i| <= 1 (edge.g); the
# relative errors of roundings.g.
#
# g*_i is its size G_i times a sign. That sign is merged into r_i and into the sign s_i of e_i,
# whose size is n_i, so it does not appear. g_i has the sign of g*_i, because its errors are
# relative. As in edge.g, the bound is shown for one side, and the hint groups terms by size.
#@ -Eprecision=200
eight_u = 8 * 1b-53;
# Refused with: eight_u = 5 * 1b-53;
inflation = 1b-40;
# Refused with: inflation = 7 * 1b-53;

e0 = n0 * s0;
e1 = n1 * s1;
e2 = n2 * s2;
g0 = G0 * ((1 + a0) * (1 + c0));
g1 = G1 * ((1 + a1) * (1 + c1));
g2 = G2 * ((1 + a2) * (1 + c2));
S = ((g0 * e0 * (1 + m0) + g1 * e1 * (1 + m1)) * (1 + m3) + g2 * e2 * (1 + m2)) * (1 + m4);
exact = G0 * (e0 + b0 * r0) + G1 * (e1 + b1 * r1) + G2 * (e2 + b2 * r2);

x0 = (b0 * (1 + inflation) * (1 + v0) + eight_u * n0) * (1 + w0);
x1 = (b1 * (1 + inflation) * (1 + v1) + eight_u * n1) * (1 + w1);
x2 = (b2 * (1 + inflation) * (1 + v2) + eight_u * n2) * (1 + w2);
H = ((g0 * x0 * (1 + h0) + g1 * x1 * (1 + h1)) * (1 + h3) + g2 * x2 * (1 + h2)) * (1 + h4);

{ a0 in [-1b-53, 1b-53] /\ a1 in [-1b-53, 1b-53] /\ a2 in [-1b-53, 1b-53] /\
  c0 in [-1b-53, 1b-53] /\ c1 in [-1b-53, 1b-53] /\ c2 in [-1b-53, 1b-53] /\
  m0 in [-1b-53, 1b-53] /\ m1 in [-1b-53, 1b-53] /\ m2 in [-1b-53, 1b-53] /\
  m3 in [-1b-53, 1b-53] /\ m4 in [-1b-53, 1b-53] /\
  v0 in [-1b-53, 1b-53] /\ v1 in [-1b-53, 1b-53] /\ v2 in [-1b-53, 1b-53] /\
  w0 in [-1b-53, 1b-53] /\ w1 in [-1b-53, 1b-53] /\ w2 in [-1b-53, 1b-53] /\
  h0 in [-1b-53, 1b-53] /\ h1 in [-1b-53, 1b-53] /\ h2 in [-1b-53, 1b-53] /\
  h3 in [-1b-53, 1b-53] /\ h4 in [-1b-53, 1b-53] /\
  G0 in [0, 1b300] /\ G1 in [0, 1b300] /\ G2 in [0, 1b300] /\
  n0 in [0, 1b700] /\ n1 in [0, 1b700] /\ n2 in [0, 1b700] /\
  b0 in [0, 1b700] /\ b1 in [0, 1b700] /\ b2 in [0, 1b700] /\
  s0 in [-1, 1] /\ s1 in [-1, 1] /\ s2 in [-1, 1] /\
  r0 in [-1, 1] /\ r1 in [-1, 1] /\ r2 in [-1, 1]
  ->
  H - (S - exact) >= 0 }

H - (S - exact) ->
    G0 * (b0 * ((1 + a0) * (1 + c0) * (1 + inflation) * (1 + v0) * (1 + w0) * (1 + h0) * (1 + h3)
                * (1 + h4) + r0)
          + n0 * (eight_u * ((1 + a0) * (1 + c0) * (1 + w0) * (1 + h0) * (1 + h3) * (1 + h4))
                  - s0 * ((1 + a0) * (1 + c0) * (1 + m0) * (1 + m3) * (1 + m4) - 1)))
  + G1 * (b1 * ((1 + a1) * (1 + c1) * (1 + inflation) * (1 + v1) * (1 + w1) * (1 + h1) * (1 + h3)
                * (1 + h4) + r1)
          + n1 * (eight_u * ((1 + a1) * (1 + c1) * (1 + w1) * (1 + h1) * (1 + h3) * (1 + h4))
                  - s1 * ((1 + a1) * (1 + c1) * (1 + m1) * (1 + m3) * (1 + m4) - 1)))
  + G2 * (b2 * ((1 + a2) * (1 + c2) * (1 + inflation) * (1 + v2) * (1 + w2) * (1 + h2) * (1 + h4)
                + r2)
          + n2 * (eight_u * ((1 + a2) * (1 + c2) * (1 + w2) * (1 + h2) * (1 + h4))
                  - s2 * ((1 + a2) * (1 + c2) * (1 + m2) * (1 + m4) - 1)));
