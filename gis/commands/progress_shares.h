/* progress_shares.h: the fraction of the progress at which each stage of a command ends. The values are estimates from
 * a layer of some thousand buildings in one file; a wrong value only makes the progress bar uneven. */
#ifndef GIS_PROGRESS_SHARES_H
#define GIS_PROGRESS_SHARES_H

/* separate: reading ends, and the separation with its proof ends. */
#define GIS_SEPARATE_READ 0.1
#define GIS_SEPARATE_DONE 0.8
/* check: it tests each pair once, hence reading takes a larger share, and writing a small one. */
#define GIS_CHECK_READ 0.3
#define GIS_CHECK_CHECKED 0.9
#define GIS_BUFFER_READ 0.1
#define GIS_BUFFER_MADE 0.9
#define GIS_FOLLOW_READ 0.2
#define GIS_FOLLOW_ATTACHED 0.6

#endif
