/* words.c: the fixed words of the public enumerations, and the versions. Each list is as long as its enumeration, which
 * the compiler tests; a number that is not one of the values has no word. */
#include "sunder.h"

#include <gmp.h>

#define WORDS(function, type, last, none, ...)                                                                         \
    const char *function(type value)                                                                                   \
    {                                                                                                                  \
        static const char *const word[] = {__VA_ARGS__};                                                               \
        _Static_assert(sizeof word / sizeof *word == (last) + 1, "one word for each value");                           \
        return (unsigned)value <= (last) ? word[value] : (none);                                                       \
    }

const char *sunder_version(void) { return SUNDER_VERSION; }

const char *sunder_gmp_version(void) { return gmp_version; }

WORDS(sunder_status_string, sunder_status, SUNDER_EFAULT, "unknown status", "no error", "invalid geometry",
      "argument out of range", "result beyond the range of doubles", "out of memory", "stopped on request",
      "more parts than can be numbered", "internal fault")

WORDS(sunder_validity_string, sunder_validity, SUNDER_VALIDITY_EVEN_ODD, "", "strict", "even-odd")

WORDS(sunder_algorithm_string, sunder_algorithm, SUNDER_ALGORITHM_DIVIDE, "", "auto", "convolution", "arrangement",
      "incremental", "divide")

WORDS(sunder_decomposition_string, sunder_decomposition, SUNDER_DECOMPOSITION_MIXED, "", "auto", "angle-bisector",
      "vertical", "triangulation", "hertel-mehlhorn", "optimal", "mixed")

WORDS(sunder_order_string, sunder_order, SUNDER_ORDER_GIVEN, "", "random", "fat", "given")

WORDS(sunder_phase_string, sunder_phase, SUNDER_PHASE_UNION, "", "decompose", "subsums", "union")

WORDS(sunder_operation_string, sunder_operation, SUNDER_OPERATION_CLOSE, "", "dilate", "erode", "open", "close")

WORDS(sunder_contact_string, sunder_contact, SUNDER_CONTACT_DEGENERATE_POINT, "", "none", "edge", "vertex", "arc",
      "degenerate_segment", "degenerate_point")

WORDS(sunder_containment_string, sunder_containment, SUNDER_CONTAINMENT_SEPARATE, "", "block", "ignore", "separate")

WORDS(sunder_feature_status_string, sunder_feature_status, SUNDER_FEATURE_HIDDEN, "", "unmoved", "moved", "fixed",
      "blocked", "skipped", "hidden")

WORDS(sunder_conflict_kind_string, sunder_conflict_kind, SUNDER_CONFLICT_TIGHT, "", "overlap", "too_close", "barrier",
      "barrier_drawn", "barrier_near", "contained", "duplicate", "worse", "limit", "side", "jump", "not_a_translate",
      "row", "needless", "altered", "too_small", "tight")

WORDS(sunder_reason_string, sunder_reason, SUNDER_REASON_ROW, "", "", "max_shift", "fixed", "side", "jump",
      "no_room", "same_block", "kept", "unresolved", "row")

WORDS(sunder_route_status_string, sunder_route_status, SUNDER_ROUTE_DISCONNECTED, "", "found", "start_in_collision",
      "goal_in_collision", "disconnected")
