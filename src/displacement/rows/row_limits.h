/* What counts as a row. ROW_STEP was chosen by pictures of three towns at gaps of 3, 5 and 10 m: many rows that 0.33
 * loses are straight, and most rows at 10 m that only a limit of one gap finds are zig-zag. ROW_STEP_GAPS is for large
 * buildings, such as the blocks of an old town: with 2, two out of line by 8.5 m were in a row at a gap of 5 m.
 * ROW_DEEP is for the perimeter blocks of old towns, which a map shows as areas: at a gap of 5 m it leaves 17 of 65
 * rows of Paris, and 622 of 641 of Liechtenstein. With 1.5 terraces with sheds were lost, with 2 more rows of Paris
 * stayed. The others are limits of a prototype, whose rows were looked at in pictures; no trial of other values is
 * recorded. */
#ifndef SUNDER_I_ROW_LIMITS_H
#define SUNDER_I_ROW_LIMITS_H

/* Neighbours in a row are at most this many gaps apart. */
#define ROW_REACH 4.0
/* The cosine of four times the angle, 15 degrees, by which the directions of their walls may differ. */
#define ROW_ANGLE 0.5
/* The least share of the length of its walls that agrees, as a vector at four times the angle, if a feature has a
 * direction at all: that of a regular polygon of more than four sides is 0. */
#define ROW_STRAIGHT 0.1
/* The share of the smaller depth that two neighbours have in common across the row at least; along the row it is at
 * most this share of the shorter length. */
#define ROW_SHARED 0.5
/* The greatest ratio of two neighbours' depths. */
#define ROW_DEPTHS 2.5
/* A block is at most this many times as deep as its deepest member. */
#define ROW_DEEP 1.75
/* The greatest offset of two neighbours, as a share of the smaller depth, and in gaps. */
#define ROW_STEP 0.4
#define ROW_STEP_GAPS 1.5

#endif
