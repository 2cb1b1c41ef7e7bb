/* FMI 3.0, model exchange and co-simulation. */
#include "model.h"
#include "model.c"
#include "fmi3Functions.h"

typedef struct {
  Model m;
  fmi3InstanceEnvironment environment;
  fmi3LogMessageCallback logger;
} Unit;
typedef fmi3Instance I;
typedef fmi3Status S;
typedef const fmi3ValueReference R[];
#define MODEL (&((Unit *)c)->m)
#define OK(condition) ((condition) ? fmi3OK : fmi3Error)

static void report(Unit *u) {
  if (u->m.code && u->m.code != u->m.reported && u->logger)
    u->logger(u->environment, fmi3Warning, "logStatus", meaning(u->m.code));
  u->m.reported = u->m.code;
}
static void solved(Unit *u) {
  solve_model(&u->m);
  report(u);
}
static I instance(fmi3String token, fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
  Unit *u;
  if (!token || strcmp(token, TOKEN)) {
    if (logger) logger(environment, fmi3Error, "logStatus", "the instantiationToken is another");
    return NULL;
  }
  if (!(u = (Unit *)calloc(1, sizeof *u))) return NULL;
  u->environment = environment;
  u->logger = logger;
  start_model(&u->m);
  return u;
}
const char *fmi3GetVersion(void) { return fmi3Version; }
S fmi3SetDebugLogging(I c, fmi3Boolean on, size_t n, const fmi3String k[]) { return fmi3OK; }
I fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String where, fmi3Boolean visible,
                               fmi3Boolean logging, fmi3InstanceEnvironment e, fmi3LogMessageCallback logger) {
  return instance(token, e, logger);
}
I fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String where, fmi3Boolean visible,
                              fmi3Boolean logging, fmi3Boolean events, fmi3Boolean early, R required, size_t n,
                              fmi3InstanceEnvironment e, fmi3LogMessageCallback logger,
                              fmi3IntermediateUpdateCallback update) {
  return instance(token, e, logger);
}
I fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token, fmi3String where, fmi3Boolean visible,
                                    fmi3Boolean logging, fmi3InstanceEnvironment e, fmi3LogMessageCallback logger,
                                    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
                                    fmi3UnlockPreemptionCallback unlock) {
  return NULL;
}
void fmi3FreeInstance(I c) { free(c); }
S fmi3EnterInitializationMode(I c, fmi3Boolean has, fmi3Float64 tol, fmi3Float64 start, fmi3Boolean ends, fmi3Float64 stop) {
  MODEL->x[0] = start;
  if (has && tol > 0) MODEL->tolerance = tol;
  return fmi3OK;
}
#define DONE(name) \
  S name(I c) { return fmi3OK; }
DONE(fmi3ExitInitializationMode) DONE(fmi3EnterEventMode) DONE(fmi3Terminate) DONE(fmi3EnterContinuousTimeMode)
DONE(fmi3EnterStepMode) DONE(fmi3EnterConfigurationMode) DONE(fmi3ExitConfigurationMode) DONE(fmi3EvaluateDiscreteStates)
S fmi3Reset(I c) { start_model(MODEL); return fmi3OK; }

S fmi3GetFloat64(I c, R r, size_t n, fmi3Float64 v[], size_t count) {
  size_t i;
  if (count != n) return fmi3Error;
  for (i = 0; i < n; ++i) {
    if (r[i] >= REALS) return fmi3Error;
    if (r[i] >= FIRST_OUTPUT) solved((Unit *)c);
    v[i] = MODEL->x[r[i]];
  }
  return fmi3OK;
}
S fmi3SetFloat64(I c, R r, size_t n, const fmi3Float64 v[], size_t count) {
  size_t i;
  if (count != n) return fmi3Error;
  for (i = 0; i < n; ++i) {
    if (r[i] == 0 || r[i] >= FIRST_OUTPUT) return fmi3Error;
    set_value(MODEL, r[i], v[i]);
  }
  return fmi3OK;
}
S fmi3GetInt32(I c, R r, size_t n, fmi3Int32 v[], size_t count) {
  size_t i;
  if (count != n) return fmi3Error;
  for (i = 0; i < n; ++i) {
    if (r[i] != REALS) return fmi3Error;
    solved((Unit *)c);
    v[i] = MODEL->code;
  }
  return fmi3OK;
}
S fmi3SetInt32(I c, R r, size_t n, const fmi3Int32 v[], size_t count) { return OK(!n); }
#define NONE(T) \
  S fmi3Get##T(I c, R r, size_t n, fmi3##T v[], size_t count) { return OK(!n); } \
  S fmi3Set##T(I c, R r, size_t n, const fmi3##T v[], size_t count) { return OK(!n); }
NONE(Float32) NONE(Int8) NONE(UInt8) NONE(Int16) NONE(UInt16) NONE(UInt32) NONE(Int64) NONE(UInt64) NONE(Boolean)
NONE(String)
S fmi3GetBinary(I c, R r, size_t n, size_t sizes[], fmi3Binary v[], size_t count) { return OK(!n); }
S fmi3SetBinary(I c, R r, size_t n, const size_t sizes[], const fmi3Binary v[], size_t count) { return OK(!n); }
S fmi3GetClock(I c, R r, size_t n, fmi3Clock v[]) { return OK(!n); }
S fmi3SetClock(I c, R r, size_t n, const fmi3Clock v[]) { return OK(!n); }
S fmi3GetNumberOfVariableDependencies(I c, fmi3ValueReference r, size_t *n) { return fmi3Error; }
S fmi3GetVariableDependencies(I c, fmi3ValueReference r, size_t a[], fmi3ValueReference b[], size_t d[],
                              fmi3DependencyKind k[], size_t n) { return fmi3Error; }
S fmi3GetFMUState(I c, fmi3FMUState *s) {
  if (!*s && !(*s = calloc(1, sizeof(Model)))) return fmi3Error;
  memcpy(*s, MODEL, sizeof(Model));
  return fmi3OK;
}
S fmi3SetFMUState(I c, fmi3FMUState s) {
  if (!s) return fmi3Error;
  memcpy(MODEL, s, sizeof(Model));
  return fmi3OK;
}
S fmi3FreeFMUState(I c, fmi3FMUState *s) {
  if (s) { free(*s); *s = NULL; }
  return fmi3OK;
}
S fmi3SerializedFMUStateSize(I c, fmi3FMUState s, size_t *n) { *n = 0; return fmi3Error; }
S fmi3SerializeFMUState(I c, fmi3FMUState s, fmi3Byte b[], size_t n) { return fmi3Error; }
S fmi3DeserializeFMUState(I c, const fmi3Byte b[], size_t n, fmi3FMUState *s) { return fmi3Error; }
S fmi3GetDirectionalDerivative(I c, R a, size_t na, R b, size_t nb, const fmi3Float64 s[], size_t ns, fmi3Float64 d[],
                               size_t nd) { return fmi3Error; }
S fmi3GetAdjointDerivative(I c, R a, size_t na, R b, size_t nb, const fmi3Float64 s[], size_t ns, fmi3Float64 d[],
                           size_t nd) { return fmi3Error; }
S fmi3GetIntervalDecimal(I c, R r, size_t n, fmi3Float64 v[], fmi3IntervalQualifier q[]) { return fmi3Error; }
S fmi3GetIntervalFraction(I c, R r, size_t n, fmi3UInt64 a[], fmi3UInt64 b[], fmi3IntervalQualifier q[]) { return fmi3Error; }
S fmi3GetShiftDecimal(I c, R r, size_t n, fmi3Float64 v[]) { return fmi3Error; }
S fmi3GetShiftFraction(I c, R r, size_t n, fmi3UInt64 a[], fmi3UInt64 b[]) { return fmi3Error; }
S fmi3SetIntervalDecimal(I c, R r, size_t n, const fmi3Float64 v[]) { return fmi3Error; }
S fmi3SetIntervalFraction(I c, R r, size_t n, const fmi3UInt64 a[], const fmi3UInt64 b[]) { return fmi3Error; }
S fmi3SetShiftDecimal(I c, R r, size_t n, const fmi3Float64 v[]) { return fmi3Error; }
S fmi3SetShiftFraction(I c, R r, size_t n, const fmi3UInt64 a[], const fmi3UInt64 b[]) { return fmi3Error; }
S fmi3UpdateDiscreteStates(I c, fmi3Boolean *need, fmi3Boolean *stop, fmi3Boolean *nominals, fmi3Boolean *values,
                           fmi3Boolean *has, fmi3Float64 *next) {
  *need = *stop = *nominals = *values = *has = fmi3False;
  return fmi3OK;
}

/* model exchange */
S fmi3CompletedIntegratorStep(I c, fmi3Boolean no, fmi3Boolean *event, fmi3Boolean *stop) {
  *event = *stop = fmi3False;
  return fmi3OK;
}
S fmi3SetTime(I c, fmi3Float64 t) { MODEL->x[0] = t; return fmi3OK; }
S fmi3SetContinuousStates(I c, const fmi3Float64 x[], size_t n) {
  if (n == STATES) set_states(MODEL, x, n);
  return OK(n == STATES);
}
S fmi3GetContinuousStates(I c, fmi3Float64 x[], size_t n) {
  if (n == STATES) get_states(MODEL, x, n);
  return OK(n == STATES);
}
S fmi3GetNominalsOfContinuousStates(I c, fmi3Float64 x[], size_t n) {
  if (n == STATES) get_nominals(x, n);
  return OK(n == STATES);
}
S fmi3GetContinuousStateDerivatives(I c, fmi3Float64 d[], size_t n) {
  if (n != STATES) return fmi3Error;
  if (n) solved((Unit *)c);
  get_derivatives(MODEL, d, n);
  return n && has_no_answer(MODEL->code) ? fmi3Discard : fmi3OK;
}
S fmi3GetEventIndicators(I c, fmi3Float64 e[], size_t n) { return OK(!n); }
S fmi3GetNumberOfEventIndicators(I c, size_t *n) { *n = 0; return fmi3OK; }
S fmi3GetNumberOfContinuousStates(I c, size_t *n) { *n = STATES; return fmi3OK; }

/* co-simulation */
S fmi3GetOutputDerivatives(I c, R r, size_t n, const fmi3Int32 o[], fmi3Float64 v[], size_t count) { return OK(!n); }
S fmi3DoStep(I c, fmi3Float64 t, fmi3Float64 h, fmi3Boolean no, fmi3Boolean *event, fmi3Boolean *stop,
             fmi3Boolean *early, fmi3Float64 *last) {
  *event = *early = fmi3False;
  *stop = !advance(MODEL, t, h); /* where it has no answer, the motion ends */
  if (*stop) report((Unit *)c);
  *last = MODEL->x[0];
  return fmi3OK;
}
S fmi3ActivateModelPartition(I c, fmi3ValueReference r, fmi3Float64 t) { return fmi3Error; }
