/* A unit without states: outputs are functions of inputs at the same instant. */
#define STATES 0
#define FIRST_STATE FIRST_OUTPUT

static int set_accelerations(Model *m) { return 0; }
static void get_derivatives(const Model *m, double *d, size_t n) {}
static void get_nominals(double *values, size_t n) {}
static int advance(Model *m, double t, double h) {
  m->x[0] = t + h;
  return 1;
}
