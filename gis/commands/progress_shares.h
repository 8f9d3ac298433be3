/* progress_shares.h: which shares of the progress bar the stages of a run have: where each ends, as a part of the
 * whole. They are guesses of what each takes on a layer of some thousand buildings in one file; all that a wrong one
 * costs is a bar that runs unevenly. */
#ifndef GIS_PROGRESS_SHARES_H
#define GIS_PROGRESS_SHARES_H

/* separate searches and proves. */
#define GIS_SEPARATE_READ 0.1
#define GIS_SEPARATE_DONE 0.8
/* check looks at each pair once: reading is a larger part, and little is written. */
#define GIS_CHECK_READ 0.3
#define GIS_CHECK_CHECKED 0.9
#define GIS_BUFFER_READ 0.1
#define GIS_BUFFER_MADE 0.9

#endif
