/* Names of streets and houses, in the scripts that a European street shows. UTF-8. */
#ifndef TOWN_NAMES_H
#define TOWN_NAMES_H

#include "random.h"

const char *town_street_name(town_random *random);
const char *town_shop_name(town_random *random);
const char *town_church_name(town_random *random);
const char *town_school_name(town_random *random);

#endif
