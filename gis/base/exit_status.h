/* exit_status.h: the exit statuses. Scripts rely on them; --help (options/help.c) and the manual page list them. */
#ifndef GIS_EXIT_STATUS_H
#define GIS_EXIT_STATUS_H

enum {
    GIS_DONE = 0,      /* the run did what was requested */
    GIS_FAILED = 1,    /* the run failed; outputs are unchanged */
    GIS_USAGE = 2,     /* the command line was wrong; nothing was done */
    GIS_UNRESOLVED = 3 /* the run is complete, but conflicts remain (separate) or were found (check), or there is no
                        * route (route); GIS_DONE with --allow-conflicts */
};

#endif
