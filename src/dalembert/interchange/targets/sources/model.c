/* Values of a mechanism on demand, shared by both versions of FMI; all is static, so that units do not clash.
 * x: time, inputs, parameters, states, outputs. Outputs are computed when one is read after an input or a state has
 * changed. */
#include "mechanism.c"
#undef REAL
#undef SIGN
#undef POSITIVE
#undef LARGER
#undef SMALLER
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
  double x[REALS], tolerance, part;
  int code, is_fresh, reported;
} Model;

static const double STARTS[REALS] = START_VALUES;
static const int V_PLACES[NUMBERS + 1] = NUMBER_PLACES;
static const int C_PLACES[CHANNELS + 1] = CHANNEL_PLACES;

static void start_model(Model *m) {
  memset(m, 0, sizeof *m);
  memcpy(m->x, STARTS, sizeof STARTS);
  m->tolerance = 1e-12;
}

static int has_no_answer(int code) { return code != 0 && code != 9; }

static void take(const Model *m, const int *places, int count, double *values) {
  int i;
  for (i = 0; i < count; ++i) values[i] = m->x[places[i]];
}

#include "states.c"

static void solve_model(Model *m) {
  double v[NUMBERS + 1], c[CHANNELS + 1];
  int i;
  if (m->is_fresh) return;
  m->code = set_accelerations(m);
  if (!has_no_answer(m->code)) {
    take(m, V_PLACES, NUMBERS, v);
    take(m, C_PLACES, CHANNELS, c);
    m->code = MODEL_FUNCTION(v, c, m->x + FIRST_RESULT);
  }
  if (has_no_answer(m->code))
    for (i = FIRST_OUTPUT; i < REALS; ++i) m->x[i] = NAN;
  m->is_fresh = 1;
}

static void set_value(Model *m, unsigned int place, double value) {
  if (m->x[place] != value) {
    m->x[place] = value;
    m->is_fresh = 0;
  }
}

static void set_states(Model *m, const double *values, size_t n) {
  size_t i;
  for (i = 0; i < n; ++i) set_value(m, (unsigned int)(FIRST_STATE + i), values[i]);
}

static void get_states(const Model *m, double *values, size_t n) {
  size_t i;
  for (i = 0; i < n; ++i) values[i] = m->x[FIRST_STATE + i];
}

static const char *meaning(int code) {
  switch (code) {
    case 1: return "the linkage does not close";
    case 2: return "no certain answer: near a dead centre, or friction may have several solutions";
    case 3: return "friction leaves an interval: a contact at rest";
    case 7: return "friction jams the mechanism";
    case 9: return "self-locking; the numbers hold";
    case 14: return "a table ends before this position";
    case 15: return "a contact that only pushes would have to pull";
  }
  return "no answer";
}
