/* The fixed words of the public enumerations. */
#include "sunder.h"

const char *sunder_version(void) { return SUNDER_VERSION; }

const char *sunder_status_string(sunder_status status)
{
    switch (status) {
    case SUNDER_OK: return "no error";
    case SUNDER_EINVALID: return "invalid geometry";
    case SUNDER_EARG: return "argument out of range";
    case SUNDER_ERANGE: return "result beyond the range of doubles";
    case SUNDER_ENOMEM: return "out of memory";
    case SUNDER_ECANCEL: return "stopped on request";
    case SUNDER_ESIZE: return "more parts than can be numbered";
    case SUNDER_EFAULT: return "internal fault";
    }
    return "unknown status";
}

/* Of a number that is none of the values: no word. */
#define WORD_OF(words, value) ((size_t)(value) < sizeof(words) / sizeof *(words) ? (words)[value] : "")

const char *sunder_contact_string(sunder_contact contact)
{
    static const char *const word[] = {"none", "edge", "vertex", "arc", "degenerate_segment", "degenerate_point"};
    return WORD_OF(word, contact);
}

const char *sunder_feature_status_string(sunder_feature_status status)
{
    static const char *const word[] = {"unmoved", "moved", "fixed", "blocked", "skipped"};
    return WORD_OF(word, status);
}

const char *sunder_conflict_kind_string(sunder_conflict_kind kind)
{
    static const char *const word[] = {"overlap", "too_close", "barrier", "contained", "duplicate"};
    return WORD_OF(word, kind);
}

const char *sunder_reason_string(sunder_reason reason)
{
    static const char *const word[] = {"", "max_shift", "fixed", "side", "no_room", "same_block", "kept", "unresolved"};
    return WORD_OF(word, reason);
}
