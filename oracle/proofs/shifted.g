# The computed G at a shifted sample differs from the exact G by at most H.
#
# Code: find_between_readings (filter_kernels.h): what FindBetweenReadings computes for one of its
# shifts,
#
#   g_i   = fl(fl(f p_i - s_i) t_i)                   f p_i is exact
#   here  = fl(fl(fl(g_0 e_0) + fl(g_1 e_1)) + fl(g_2 e_2))     the loop's first sum, 0 + z, is z
#   along_x, along_y: like `here`, with the coefficients a_i and b_i in place of e_i
#   there = fl(fl(here - fl(along_x x)) - fl(along_y y))
#   l_i   = fl(edge_error_i + 16u |e_i|)
#   H     = fl(fl(fl(|g_0| l_0) + fl(|g_1| l_1)) + fl(|g_2| l_2))
#
# Assumes:
#
# - The exact E_i is e_i + band_i r_i with |r_i| <= 1 (edge.g).
# - The coefficients a_i and b_i are within 4u of the exact A_i and B_i (limbs.g).
# - Let R be the largest shift of a sample (placement_filter.h: reach S/(1 - rho)). The exact shift
#   along x is R s, |s| <= 1, and the computed one is within R (share + 2^-41) of it. `share` bounds
#   the effect of the errors of E_i, and 2^-41 is more than 200 roundings.
# - edge_error_i >= band_i (1 + 2^-40) + (|A_i| + |B_i|) R (share + 2^-40).
# - The relative errors of roundings.g.
#
# Below, b_i is band_i, and p_i and q_i are |A_i| R and |B_i| R; all other names are as in value.g.
#@ -Eprecision=200
sixteen_u = 16 * 1b-53;
# Refused with: sixteen_u = 6 * 1b-53;
inflation = 1b-40;
# Refused with: inflation = 1b-42;
shift_error = 1b-41;

e0 = n0 * s0;
e1 = n1 * s1;
e2 = n2 * s2;
g0 = G0 * ((1 + a0) * (1 + c0));
g1 = G1 * ((1 + a1) * (1 + c1));
g2 = G2 * ((1 + a2) * (1 + c2));
here = ((g0 * e0 * (1 + m0) + g1 * e1 * (1 + m1)) * (1 + m3) + g2 * e2 * (1 + m2)) * (1 + m4);
x0 = p0 * ((1 + k0) * (t0 + (share + shift_error) * w0));
x1 = p1 * ((1 + k1) * (t1 + (share + shift_error) * w1));
x2 = p2 * ((1 + k2) * (t2 + (share + shift_error) * w2));
y0 = q0 * ((1 + j0) * (u0 + (share + shift_error) * z0));
y1 = q1 * ((1 + j1) * (u1 + (share + shift_error) * z1));
y2 = q2 * ((1 + j2) * (u2 + (share + shift_error) * z2));
by_x = ((g0 * x0 * (1 + f0) + g1 * x1 * (1 + f1)) * (1 + f3) + g2 * x2 * (1 + f2)) * (1 + f4)
    * (1 + f5);
by_y = ((g0 * y0 * (1 + d0) + g1 * y1 * (1 + d1)) * (1 + d3) + g2 * y2 * (1 + d2)) * (1 + d4)
    * (1 + d5);
there = ((here - by_x) * (1 + o0) - by_y) * (1 + o1);
exact = G0 * (e0 + b0 * r0 - p0 * t0 - q0 * u0) + G1 * (e1 + b1 * r1 - p1 * t1 - q1 * u1) + G2
    * (e2 + b2 * r2 - p2 * t2 - q2 * u2);

l0 = (b0 * (1 + inflation) + (p0 + q0) * (share + inflation) + sixteen_u * n0) * (1 + v0);
l1 = (b1 * (1 + inflation) + (p1 + q1) * (share + inflation) + sixteen_u * n1) * (1 + v1);
l2 = (b2 * (1 + inflation) + (p2 + q2) * (share + inflation) + sixteen_u * n2) * (1 + v2);
H = ((g0 * l0 * (1 + h0) + g1 * l1 * (1 + h1)) * (1 + h3) + g2 * l2 * (1 + h2)) * (1 + h4);

{ a0 in [-1b-53, 1b-53] /\ a1 in [-1b-53, 1b-53] /\ a2 in [-1b-53, 1b-53] /\
  c0 in [-1b-53, 1b-53] /\ c1 in [-1b-53, 1b-53] /\ c2 in [-1b-53, 1b-53] /\
  m0 in [-1b-53, 1b-53] /\ m1 in [-1b-53, 1b-53] /\ m2 in [-1b-53, 1b-53] /\
  m3 in [-1b-53, 1b-53] /\ m4 in [-1b-53, 1b-53] /\ f0 in [-1b-53, 1b-53] /\
  f1 in [-1b-53, 1b-53] /\ f2 in [-1b-53, 1b-53] /\ f3 in [-1b-53, 1b-53] /\
  f4 in [-1b-53, 1b-53] /\ f5 in [-1b-53, 1b-53] /\ d0 in [-1b-53, 1b-53] /\
  d1 in [-1b-53, 1b-53] /\ d2 in [-1b-53, 1b-53] /\ d3 in [-1b-53, 1b-53] /\
  d4 in [-1b-53, 1b-53] /\ d5 in [-1b-53, 1b-53] /\ o0 in [-1b-53, 1b-53] /\
  o1 in [-1b-53, 1b-53] /\ v0 in [-1b-53, 1b-53] /\ v1 in [-1b-53, 1b-53] /\
  v2 in [-1b-53, 1b-53] /\ h0 in [-1b-53, 1b-53] /\ h1 in [-1b-53, 1b-53] /\
  h2 in [-1b-53, 1b-53] /\ h3 in [-1b-53, 1b-53] /\ h4 in [-1b-53, 1b-53] /\
  k0 in [-1b-51, 1b-51] /\ j0 in [-1b-51, 1b-51] /\ k1 in [-1b-51, 1b-51] /\
  j1 in [-1b-51, 1b-51] /\ k2 in [-1b-51, 1b-51] /\ j2 in [-1b-51, 1b-51] /\
  G0 in [0, 1b300] /\ n0 in [0, 1b700] /\ b0 in [0, 1b700] /\
  p0 in [0, 1b700] /\ q0 in [0, 1b700] /\ s0 in [-1, 1] /\
  r0 in [-1, 1] /\ t0 in [-1, 1] /\ u0 in [-1, 1] /\
  w0 in [-1, 1] /\ z0 in [-1, 1] /\ G1 in [0, 1b300] /\
  n1 in [0, 1b700] /\ b1 in [0, 1b700] /\ p1 in [0, 1b700] /\
  q1 in [0, 1b700] /\ s1 in [-1, 1] /\ r1 in [-1, 1] /\
  t1 in [-1, 1] /\ u1 in [-1, 1] /\ w1 in [-1, 1] /\
  z1 in [-1, 1] /\ G2 in [0, 1b300] /\ n2 in [0, 1b700] /\
  b2 in [0, 1b700] /\ p2 in [0, 1b700] /\ q2 in [0, 1b700] /\
  s2 in [-1, 1] /\ r2 in [-1, 1] /\ t2 in [-1, 1] /\
  u2 in [-1, 1] /\ w2 in [-1, 1] /\ z2 in [-1, 1] /\
  share in [0, 0.25]
  ->
  H - (there - exact) >= 0 }

H - (there - exact) ->
    G0 * (b0 * ((1 + inflation) * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1
        + h4)) + r0)
          + n0 * (sixteen_u * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1 + h4))
                  - s0 * ((1 + a0) * (1 + c0) * (1 + m0) * (1 + m3) * (1 + m4) * (1 + o0) * (1
                      + o1) - 1))
          + p0 * (share * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1 + h4) + w0
              * ((1 + a0) * (1 + c0) * (1 + k0) * (1 + f0) * (1 + f3) * (1 + f4) * (1 + f5) * (1
              + o0) * (1 + o1)))
                  + inflation * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1
                      + h4)) + shift_error * (w0 * ((1 + a0) * (1 + c0) * (1 + k0) * (1 + f0)
                      * (1 + f3) * (1 + f4) * (1 + f5) * (1 + o0) * (1 + o1)))
                  + t0 * ((1 + a0) * (1 + c0) * (1 + k0) * (1 + f0) * (1 + f3) * (1 + f4) * (1
                      + f5) * (1 + o0) * (1 + o1) - 1))
          + q0 * (share * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1 + h4) + z0
              * ((1 + a0) * (1 + c0) * (1 + j0) * (1 + d0) * (1 + d3) * (1 + d4) * (1 + d5) * (1
              + o1)))
                  + inflation * ((1 + a0) * (1 + c0) * (1 + v0) * (1 + h0) * (1 + h3) * (1
                      + h4)) + shift_error * (z0 * ((1 + a0) * (1 + c0) * (1 + j0) * (1 + d0)
                      * (1 + d3) * (1 + d4) * (1 + d5) * (1 + o1)))
                  + u0 * ((1 + a0) * (1 + c0) * (1 + j0) * (1 + d0) * (1 + d3) * (1 + d4) * (1
                      + d5) * (1 + o1) - 1)))
  + G1 * (b1 * ((1 + inflation) * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1
      + h4)) + r1)
          + n1 * (sixteen_u * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1 + h4))
                  - s1 * ((1 + a1) * (1 + c1) * (1 + m1) * (1 + m3) * (1 + m4) * (1 + o0) * (1
                      + o1) - 1))
          + p1 * (share * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1 + h4) + w1
              * ((1 + a1) * (1 + c1) * (1 + k1) * (1 + f1) * (1 + f3) * (1 + f4) * (1 + f5) * (1
              + o0) * (1 + o1)))
                  + inflation * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1
                      + h4)) + shift_error * (w1 * ((1 + a1) * (1 + c1) * (1 + k1) * (1 + f1)
                      * (1 + f3) * (1 + f4) * (1 + f5) * (1 + o0) * (1 + o1)))
                  + t1 * ((1 + a1) * (1 + c1) * (1 + k1) * (1 + f1) * (1 + f3) * (1 + f4) * (1
                      + f5) * (1 + o0) * (1 + o1) - 1))
          + q1 * (share * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1 + h4) + z1
              * ((1 + a1) * (1 + c1) * (1 + j1) * (1 + d1) * (1 + d3) * (1 + d4) * (1 + d5) * (1
              + o1)))
                  + inflation * ((1 + a1) * (1 + c1) * (1 + v1) * (1 + h1) * (1 + h3) * (1
                      + h4)) + shift_error * (z1 * ((1 + a1) * (1 + c1) * (1 + j1) * (1 + d1)
                      * (1 + d3) * (1 + d4) * (1 + d5) * (1 + o1)))
                  + u1 * ((1 + a1) * (1 + c1) * (1 + j1) * (1 + d1) * (1 + d3) * (1 + d4) * (1
                      + d5) * (1 + o1) - 1)))
  + G2 * (b2 * ((1 + inflation) * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4)) + r2)
          + n2 * (sixteen_u * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4))
                  - s2 * ((1 + a2) * (1 + c2) * (1 + m2) * (1 + m4) * (1 + o0) * (1 + o1) - 1))
          + p2 * (share * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4) + w2 * ((1 + a2)
              * (1 + c2) * (1 + k2) * (1 + f2) * (1 + f4) * (1 + f5) * (1 + o0) * (1 + o1)))
                  + inflation * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4))
                      + shift_error * (w2 * ((1 + a2) * (1 + c2) * (1 + k2) * (1 + f2) * (1
                      + f4) * (1 + f5) * (1 + o0) * (1 + o1)))
                  + t2 * ((1 + a2) * (1 + c2) * (1 + k2) * (1 + f2) * (1 + f4) * (1 + f5) * (1
                      + o0) * (1 + o1) - 1))
          + q2 * (share * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4) + z2 * ((1 + a2)
              * (1 + c2) * (1 + j2) * (1 + d2) * (1 + d4) * (1 + d5) * (1 + o1)))
                  + inflation * ((1 + a2) * (1 + c2) * (1 + v2) * (1 + h2) * (1 + h4))
                      + shift_error * (z2 * ((1 + a2) * (1 + c2) * (1 + j2) * (1 + d2) * (1
                      + d4) * (1 + d5) * (1 + o1)))
                  + u2 * ((1 + a2) * (1 + c2) * (1 + j2) * (1 + d2) * (1 + d4) * (1 + d5) * (1
                      + o1) - 1)));
