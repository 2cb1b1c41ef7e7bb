/* A four-bar by hand: positions, velocities, accelerations, reactions and torque, several positions side by side.
 * The bar for the generated code: the same textbook formulas, written out straight, one vector instruction each.
 * v: a b l2x l2y l3 d l4.. see below; c: cos q, sin q (block, 2, lane); out (9, position). */
#ifndef LANES
#define LANES 8
#endif
typedef double vec __attribute__((vector_size(8 * LANES), aligned(8)));
#if LANES == 8
#include <immintrin.h>
static inline vec root(vec x) { return (vec)_mm512_sqrt_pd((__m512d)x); }
#elif LANES == 4
#include <immintrin.h>
static inline vec root(vec x) { return (vec)_mm256_sqrt_pd((__m256d)x); }
#else
#include <math.h>
static inline vec root(vec x) { for (int i = 0; i < LANES; ++i) x[i] = sqrt(x[i]); return x; }
#endif
static inline vec all(double x) { vec r; for (int i = 0; i < LANES; ++i) r[i] = x; return r; }

/* numbers of a design: crank a, coupler b, rocker r, ground (gx, gy); of each link mass, centre (x, y), inertia;
 * force on the coupler (fx, fy) at (px, py); couple on the rocker; speed, acceleration */
void hand(const double *restrict values, const double *restrict c, double *restrict out, long designs, long blocks)
{
  const long row = blocks * LANES;
  for (long d = 0; d < designs; ++d) {
    const double *n = values + 24 * d;
    double *page = out + 9 * row * d;
    const vec a = all(n[0]), b = all(n[1]), r = all(n[2]), gx = all(n[3]), gy = all(n[4]);
    const vec m2 = all(n[5]), x2 = all(n[6]), y2 = all(n[7]), i2 = all(n[8]);
    const vec m3 = all(n[9]), x3 = all(n[10]), y3 = all(n[11]), i3 = all(n[12]);
    const vec m4 = all(n[13]), x4 = all(n[14]), y4 = all(n[15]), i4 = all(n[16]);
    const vec fx = all(n[17]), fy = all(n[18]), px = all(n[19]), py = all(n[20]), t4 = all(n[21]);
    const vec w2 = all(n[22]), al2 = all(n[23]);
    const vec ib = 1 / b, ir = 1 / r, half = all(0.5), w22 = w2 * w2, b2 = b * b, dif = b * b - r * r;
    for (long k = 0; k < blocks; ++k) {
      const vec cq = *(const vec *)(c + k * 2 * LANES), sq = *(const vec *)(c + k * 2 * LANES + LANES);
      const vec ax = a * cq, ay = a * sq;                    /* crank pin */
      const vec dx = gx - ax, dy = gy - ay, d2 = dx * dx + dy * dy, over = 1 / d2;
      const vec t = half * (over * dif + 1), h = root(over * b2 - t * t);
      const vec ex = t * dx - h * dy, ey = t * dy + h * dx;  /* coupler, A to B */
      const vec sx = ex - dx, sy = ey - dy;                  /* rocker, O4 to B */
      const vec c3 = ex * ib, s3 = ey * ib, c4 = sx * ir, s4 = sy * ir;
      const vec idet = 1 / (ex * sy - ey * sx);
      const vec vx = -w2 * ay, vy = w2 * ax;                 /* velocity of A; w3 x e - w4 x s = -v */
      const vec w3 = -(vx * sx + vy * sy) * idet, w4 = -(vx * ex + vy * ey) * idet;
      const vec ux = -al2 * ay - w22 * ax, uy = al2 * ax - w22 * ay;
      const vec w33 = w3 * w3, w44 = w4 * w4;
      const vec qx = ux - w33 * ex + w44 * sx, qy = uy - w33 * ey + w44 * sy;
      const vec al3 = -(qx * sx + qy * sy) * idet, al4 = -(qx * ex + qy * ey) * idet;
      const vec g2x = x2 * cq - y2 * sq, g2y = x2 * sq + y2 * cq;
      const vec g3x = x3 * c3 - y3 * s3, g3y = x3 * s3 + y3 * c3;
      const vec g4x = x4 * c4 - y4 * s4, g4y = x4 * s4 + y4 * c4;
      const vec f2x = m2 * (-al2 * g2y - w22 * g2x), f2y = m2 * (al2 * g2x - w22 * g2y);
      const vec f3x = m3 * (ux - al3 * g3y - w33 * g3x) - fx, f3y = m3 * (uy + al3 * g3x - w33 * g3y) - fy;
      const vec f4x = m4 * (-al4 * g4y - w44 * g4x), f4y = m4 * (al4 * g4x - w44 * g4y);
      const vec p3x = px * c3 - py * s3, p3y = px * s3 + py * c3;
      /* moments about A of the coupler and about O4 of the rocker give the force B on the rocker */
      const vec k3 = i3 * al3 + m3 * (g3x * (uy + al3 * g3x - w33 * g3y) - g3y * (ux - al3 * g3y - w33 * g3x))
                     - (p3x * fy - p3y * fx);
      const vec k4 = i4 * al4 + g4x * f4y - g4y * f4x - t4;
      const vec bx = (-k3 * sx - k4 * ex) * idet, by = (-k3 * sy - k4 * ey) * idet;
      const vec ax3 = f3x + bx, ay3 = f3y + by;              /* A on the coupler */
      const vec o2x = f2x + ax3, o2y = f2y + ay3, o4x = f4x - bx, o4y = f4y - by;
      const vec torque = i2 * al2 + g2x * f2y - g2y * f2x + ax * ay3 - ay * ax3;
      const vec all9[9] = {torque, o2x, o2y, ax3, ay3, bx, by, o4x, o4y};
      for (int i = 0; i < 9; ++i) *(vec *)(page + i * row + k * LANES) = all9[i];
    }
  }
}
