/* message.h: one line a message on stderr, "sunder: error: ..." or "sunder: warning: ...", and the exit statuses. */
#ifndef SUNDER_GIS_MESSAGE_H
#define SUNDER_GIS_MESSAGE_H

enum { EXIT_STATUS_DONE = 0, EXIT_STATUS_FAILED = 1, EXIT_STATUS_USAGE = 2, EXIT_STATUS_CONFLICTS = 3 };

void message_error(const char *format, ...) __attribute__((format(printf, 1, 2)));
void message_warning(const char *format, ...) __attribute__((format(printf, 1, 2)));
/* Says that memory is out; returns EXIT_STATUS_FAILED. */
int message_out_of_memory(void);

#endif
