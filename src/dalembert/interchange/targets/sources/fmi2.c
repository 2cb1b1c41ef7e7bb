/* FMI 2.0, model exchange and co-simulation. */
#include "model.h"
#include "model.c"
#include "fmi2Functions.h"

typedef struct {
  Model m;
  const fmi2CallbackFunctions *callbacks;
  char name[200];
} Unit;
#define MODEL (&((Unit *)c)->m)
#define OK(condition) ((condition) ? fmi2OK : fmi2Error)

static void report(Unit *u) {
  if (u->m.code && u->m.code != u->m.reported && u->callbacks && u->callbacks->logger)
    u->callbacks->logger(u->callbacks->componentEnvironment, u->name, fmi2Warning, "logStatus", "%s", meaning(u->m.code));
  u->m.reported = u->m.code;
}
static void solved(Unit *u) {
  solve_model(&u->m);
  report(u);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String k[]) { return fmi2OK; }
fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String where,
                              const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging) {
  Unit *u;
  if (!guid || strcmp(guid, TOKEN)) {
    if (callbacks && callbacks->logger)
      callbacks->logger(callbacks->componentEnvironment, name, fmi2Error, "logStatus", "the guid is another");
    return NULL;
  }
  if (!(u = (Unit *)calloc(1, sizeof *u))) return NULL;
  u->callbacks = callbacks;
  if (name) strncpy(u->name, name, sizeof u->name - 1);
  start_model(&u->m);
  return u;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has, fmi2Real tol, fmi2Real start, fmi2Boolean ends,
                               fmi2Real stop) {
  MODEL->x[0] = start;
  if (has && tol > 0) MODEL->tolerance = tol;
  return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { start_model(MODEL); return fmi2OK; }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[]) {
  size_t i;
  for (i = 0; i < n; ++i) {
    if (r[i] >= REALS) return fmi2Error;
    if (r[i] >= FIRST_OUTPUT) solved((Unit *)c);
    v[i] = MODEL->x[r[i]];
  }
  return fmi2OK;
}
fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[]) {
  size_t i;
  for (i = 0; i < n; ++i) {
    if (r[i] == 0 || r[i] >= FIRST_OUTPUT) return fmi2Error;
    set_value(MODEL, r[i], v[i]);
  }
  return fmi2OK;
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer v[]) {
  size_t i;
  for (i = 0; i < n; ++i) {
    if (r[i] != REALS) return fmi2Error;
    solved((Unit *)c);
    v[i] = MODEL->code;
  }
  return fmi2OK;
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer v[]) { return OK(!n); }
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Boolean v[]) { return OK(!n); }
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Boolean v[]) { return OK(!n); }
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2String v[]) { return OK(!n); }
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2String v[]) { return OK(!n); }

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *s) {
  if (!*s && !(*s = calloc(1, sizeof(Model)))) return fmi2Error;
  memcpy(*s, MODEL, sizeof(Model));
  return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s) {
  if (!s) return fmi2Error;
  memcpy(MODEL, s, sizeof(Model));
  return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *s) {
  if (s) { free(*s); *s = NULL; }
  return fmi2OK;
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate s, size_t *n) { *n = 0; return fmi2Error; }
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate s, fmi2Byte b[], size_t n) { return fmi2Error; }
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte b[], size_t n, fmi2FMUstate *s) { return fmi2Error; }
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference a[], size_t na,
                                        const fmi2ValueReference b[], size_t nb, const fmi2Real d[], fmi2Real e[]) {
  return fmi2Error;
}

/* model exchange */
fmi2Status fmi2EnterEventMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *e) { memset(e, 0, sizeof *e); return fmi2OK; }
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean no, fmi2Boolean *event, fmi2Boolean *stop) {
  *event = *stop = fmi2False;
  return fmi2OK;
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real t) { MODEL->x[0] = t; return fmi2OK; }
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real x[], size_t n) {
  if (n == STATES) set_states(MODEL, x, n);
  return OK(n == STATES);
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real x[], size_t n) {
  if (n == STATES) get_states(MODEL, x, n);
  return OK(n == STATES);
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real x[], size_t n) {
  if (n == STATES) get_nominals(x, n);
  return OK(n == STATES);
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real d[], size_t n) {
  if (n != STATES) return fmi2Error;
  if (n) solved((Unit *)c);
  get_derivatives(MODEL, d, n);
  return n && has_no_answer(MODEL->code) ? fmi2Discard : fmi2OK;
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real e[], size_t n) { return OK(!n); }

/* co-simulation */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                       const fmi2Real v[]) { return OK(!n); }
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Integer o[],
                                        fmi2Real v[]) { return OK(!n); }
fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean no) {
  if (advance(MODEL, t, h)) return fmi2OK;
  report((Unit *)c);
  return fmi2Discard;
}
fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2Error; }
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind k, fmi2Status *v) { return fmi2Discard; }
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind k, fmi2Real *v) {
  *v = MODEL->x[0];
  return k == fmi2LastSuccessfulTime ? fmi2OK : fmi2Discard;
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind k, fmi2Integer *v) { return fmi2Discard; }
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind k, fmi2Boolean *v) {
  *v = fmi2True; /* asked after a step that was discarded: the motion ends there */
  return k == fmi2Terminated ? fmi2OK : fmi2Discard;
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind k, fmi2String *v) { return fmi2Discard; }
