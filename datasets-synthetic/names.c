#include "names.h"

#define PICK(random, list) (list)[town_random_below((random), sizeof(list) / sizeof((list)[0]))]

const char *town_street_name(town_random *random)
{
    static const char *const names[] = {
        "Lindenweg",      "Mühlgasse",     "Am Bächle",       "Schloßstraße",   "Gärtnerweg",    "Rue de l’Église",
        "Kirchgasse",     "Spöttelgasse",  "Jägerstraße",     "Eichenweg",      "Höhenweg",      "Obere Gasse",
        "Untere Gasse",   "Bahnhofstraße", "Łódzka",          "Brunnenstraße",  "Rößlesweg",     "Ahornweg",
        "Goethestraße",   "Čapkova",       "Schulstraße",     "Weinbergstraße", "Blücherstraße", "Am Mühlkanal",
        "Gerbergasse",    "Färbergasse",   "Ziegelhüttenweg", "Neue Straße",    "Kapellenweg",   "Im Grün",
        "Dr.-Ruß-Straße", "Torgasse",
    };
    return PICK(random, names);
}

const char *town_shop_name(town_random *random)
{
    static const char *const names[] = {
        "Bäckerei Müller",  "Metzgerei Bühler", "Gasthaus Zum Löwen", "Café Żuraw",      "Ταβέρνα Σωκράτης",
        "Чайная «Самовар»", "Crêperie Chloé",   "寿司さくら",         "Apotheke am Tor", "Blumen Weiß",
        "Buchhandlung Roß", "Schuster Đorđe",   "Eiscafé Venezia",    "Optik Sørensen",  "مطعم الشام",
        "Uhren Çelik",      "Weinstube Krone",  "Friseur Šárka",
    };
    return PICK(random, names);
}

const char *town_church_name(town_random *random)
{
    static const char *const names[] = {"St. Gallus",       "Frauenkirche",        "Église Saint-Étienne",
                                        "Kościół św. Anny", "Heilig-Kreuz-Kirche", "Schloßkirche"};
    return PICK(random, names);
}

const char *town_school_name(town_random *random)
{
    static const char *const names[] = {"Grundschule am Bächle", "Käthe-Kollwitz-Schule", "Gymnasium",
                                        "Collège Molière", "Realschule Süd"};
    return PICK(random, names);
}
