/* Forward dynamics of DRIVES drives: positions and speeds are states, and M a = effort - h gives the accelerations. */
#define STATES (2 * DRIVES)
#define FIRST_EFFORT 1
#define FIRST_STATE (FIRST_OUTPUT - STATES)
#define STAGES 7

static const int T_PLACES[TERM_CHANNELS + 1] = TERM_CHANNEL_PLACES;
static const double NOMINAL[DRIVES] = NOMINAL_VALUES;

/* Gauss's elimination with row exchanges; 0 if the matrix is singular. */
static int solve_linear(double a[DRIVES][DRIVES], double *x) {
  int i, j, k;
  for (k = 0; k < DRIVES; ++k) {
    int best = k;
    double swap;
    for (i = k + 1; i < DRIVES; ++i)
      if (fabs(a[i][k]) > fabs(a[best][k])) best = i;
    if (!(fabs(a[best][k]) > 0)) return 0;
    for (j = 0; j < DRIVES; ++j) swap = a[k][j], a[k][j] = a[best][j], a[best][j] = swap;
    swap = x[k], x[k] = x[best], x[best] = swap;
    for (i = k + 1; i < DRIVES; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (j = k; j < DRIVES; ++j) a[i][j] -= factor * a[k][j];
      x[i] -= factor * x[k];
    }
  }
  for (k = DRIVES - 1; k >= 0; --k) {
    for (j = k + 1; j < DRIVES; ++j) x[k] -= a[k][j] * x[j];
    x[k] /= a[k][k];
  }
  return 1;
}

static int set_accelerations(Model *m) {
  double v[NUMBERS + 1], c[TERM_CHANNELS + 1], terms[DRIVES * (DRIVES + 1)], mass[DRIVES][DRIVES];
  double *a = m->x + FIRST_OUTPUT;
  int i, code;
  for (i = 0; i < DRIVES; ++i) a[i] = 0;
  take(m, V_PLACES, NUMBERS, v);
  take(m, T_PLACES, TERM_CHANNELS, c);
  code = TERMS_FUNCTION(v, c, terms);
  if (has_no_answer(code)) return code;
  memcpy(mass, terms + DRIVES, sizeof mass);
  for (i = 0; i < DRIVES; ++i) a[i] = m->x[FIRST_EFFORT + i] - terms[i];
  return solve_linear(mass, a) ? code : 2;
}

static void get_derivatives(const Model *m, double *d, size_t n) {
  memcpy(d, m->x + FIRST_STATE + DRIVES, DRIVES * sizeof *d);
  memcpy(d + DRIVES, m->x + FIRST_OUTPUT, DRIVES * sizeof *d);
}

static void get_nominals(double *values, size_t n) {
  memcpy(values, NOMINAL, sizeof NOMINAL);
  memcpy(values + DRIVES, NOMINAL, sizeof NOMINAL);
}

/* One step of Dormand and Prince's method of order 5: y to next; its error over the tolerance, below 0 without answer. */
static double try_step(Model *m, const double *y, double h, double *next) {
  static const double A[STAGES][STAGES - 1] = {
      {0},
      {1.0 / 5},
      {3.0 / 40, 9.0 / 40},
      {44.0 / 45, -56.0 / 15, 32.0 / 9},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
  static const double E[STAGES] = {71.0 / 57600, 0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
  double d[STAGES][STATES], *x = m->x + FIRST_STATE, worst = 0;
  int i, j, k;
  for (i = 0; i < STAGES; ++i) {
    for (k = 0; k < STATES; ++k) {
      double sum = 0;
      for (j = 0; j < i; ++j) sum += A[i][j] * d[j][k];
      x[k] = y[k] + h * sum;
    }
    m->code = set_accelerations(m);
    if (has_no_answer(m->code)) return -1;
    get_derivatives(m, d[i], STATES);
  }
  memcpy(next, x, STATES * sizeof *x);
  for (k = 0; k < STATES; ++k) {
    double error = 0;
    for (i = 0; i < STAGES; ++i) error += h * E[i] * d[i][k];
    error = fabs(error) / (m->tolerance * (NOMINAL[k % DRIVES] + fabs(y[k])));
    if (!(error <= worst)) worst = error;
  }
  return worst;
}

/* From t to t + h, in steps whose error is within the tolerance; 0 where it ends before, at the time x[0]. */
static int advance(Model *m, double t, double h) {
  double y[STATES], next[STATES], part = m->part > 0 ? m->part : h, left = h;
  memcpy(y, m->x + FIRST_STATE, sizeof y);
  m->is_fresh = 0;
  while (left > 0) {
    const int is_last = part >= left;
    const double step = is_last ? left : part, error = try_step(m, y, step, next);
    const double factor = error < 0 ? 0.25 : error > 0 ? 0.9 * pow(error, -0.2) : 5;
    if (error >= 0 && error <= 1) {
      memcpy(y, next, sizeof y);
      left = is_last ? 0 : left - step;
      if (!(is_last && part > step * factor)) part = step * (factor < 5 ? factor : 5);
      m->part = part;
    } else {
      part = step * (factor > 0.1 ? factor : 0.1);
      if (!(part > 1e-12 * h)) break;
    }
  }
  memcpy(m->x + FIRST_STATE, y, sizeof y);
  m->x[0] = t + h - left;
  return left <= 0;
}
