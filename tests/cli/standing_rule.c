/* Reads lines "NAME<tab>GAP<tab>WKT<tab>WKT<tab>WKT<tab>WKT": the two features before, then after. Prints the pairs
 * that violate the rule that no conflict gets worse, computed in rationals by brute force; exits with 1 if there is
 * any. */
#include "standing.h"

#include <stdlib.h>
#include <string.h>

int main(void)
{
    static char line[1 << 20];
    int broken = 0;
    while (fgets(line, sizeof line, stdin)) {
        char *field[6];
        size_t n = 0;
        line[strcspn(line, "\n")] = 0;
        for (char *at = line; n < 6; at = field[n - 1] + strlen(field[n - 1]) + 1) {
            field[n++] = at;
            char *end = strchr(at, '\t');
            if (!end) break;
            *end = 0;
        }
        polyset set[4];
        for (size_t k = 0; k < 4; k++) {
            polyset_init(&set[k]);
            if (n < 6 || !polyset_read_wkt(&set[k], field[k + 2], NULL)) {
                fprintf(stderr, "standing_rule: not a pair: %s\n", line);
                return 2;
            }
        }
        const char *wrong = standing_rule(&set[0], &set[1], &set[2], &set[3], atof(field[1]));
        if (wrong) {
            printf("%s %s\n", field[0], wrong);
            broken = 1;
        }
        for (size_t k = 0; k < 4; k++) polyset_free(&set[k]);
    }
    return broken;
}
