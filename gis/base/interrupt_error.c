/* interrupt_error.c: see interrupt.h. Turns an interruption into an error. */
#include "base/interrupt.h"

bool gis_go_on(gis_error *error) { return !gis_interrupted() || gis_fail(error, GIS_INTERRUPTED); }

bool gis_decide(gis_error *error)
{
    gis_hold();
    bool done = gis_go_on(error);
    if (done) gis_set_outcome(GIS_DECIDING);
    gis_release();
    return done;
}
