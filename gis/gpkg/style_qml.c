/* style_qml.c: the QGIS style documents, composed of a few symbols.
 *
 * Colours: unmoved features are grey, moved ones teal, fixed ones near black, blocked ones red; arrows are blue,
 * conflicts magenta, those with barriers violet. A proved conflict has a disc and a thick line, an unresolved one a
 * ring and a thin line. Teal, red, blue and magenta also differ in lightness, so most colour-blind readers can
 * distinguish them. Properties are written as <prop>, which QGIS 3.0 and all later versions read. */
#include "gpkg/layer_styles.h"
#include "sunder.h"

#include <stdio.h>

typedef enum kind { OF_POINTS, OF_LINES, OF_POLYGONS } kind;

static kind kind_of(OGRwkbGeometryType type)
{
    OGRwkbGeometryType flat = wkbFlatten(type);
    if (flat == wkbPoint || flat == wkbMultiPoint) return OF_POINTS;
    if (OGR_GT_IsSubClassOf(flat, wkbCurve) || OGR_GT_IsSubClassOf(flat, wkbMultiCurve)) return OF_LINES;
    return OF_POLYGONS;
}

static void add_property(gis_text *to, const char *key, const char *value)
{
    gis_text_print(to, "<prop k=\"%s\" v=\"%s\"/>", key, value);
}

static void begin_layer(gis_text *to, const char *class)
{
    gis_text_print(to, "<layer class=\"%s\" enabled=\"1\" pass=\"0\" locked=\"0\">", class);
}

/* line: the style of the outline, such as solid or dot. */
static void add_fill(gis_text *to, const char *colour, const char *outline, const char *line)
{
    begin_layer(to, "SimpleFill");
    add_property(to, "color", colour);
    add_property(to, "style", "solid");
    add_property(to, "outline_style", line);
    add_property(to, "outline_color", outline);
    add_property(to, "outline_width", "0.1");
    add_property(to, "outline_width_unit", "MM");
    gis_text_print(to, "</layer>");
}

static void add_line(gis_text *to, const char *colour, const char *width)
{
    begin_layer(to, "SimpleLine");
    add_property(to, "line_color", colour);
    add_property(to, "line_style", "solid");
    add_property(to, "line_width", width);
    add_property(to, "line_width_unit", "MM");
    add_property(to, "capstyle", "round");
    gis_text_print(to, "</layer>");
}

/* Adds a property of a symbol layer that is given by a QGIS expression. */
static void add_expression(gis_text *to, const char *property, const char *expression)
{
    gis_text_print(to,
                   "<data_defined_properties><Option type=\"Map\"><Option name=\"name\" type=\"QString\" value=\"\"/>"
                   "<Option name=\"properties\" type=\"Map\"><Option name=\"%s\" type=\"Map\">"
                   "<Option name=\"active\" type=\"bool\" value=\"true\"/>"
                   "<Option name=\"expression\" type=\"QString\" value=\"%s\"/>"
                   "<Option name=\"type\" type=\"int\" value=\"3\"/></Option></Option>"
                   "<Option name=\"type\" type=\"QString\" value=\"collection\"/></Option>"
                   "</data_defined_properties>",
                   property, expression);
}

/* Adds a line whose width, in millimetres, is given by a QGIS expression. */
static void add_line_by(gis_text *to, const char *colour, const char *expression)
{
    begin_layer(to, "SimpleLine");
    add_property(to, "line_color", colour);
    add_property(to, "line_style", "solid");
    add_property(to, "line_width", "0.3");
    add_property(to, "line_width_unit", "MM");
    add_property(to, "capstyle", "round");
    add_expression(to, "outlineWidth", expression);
    gis_text_print(to, "</layer>");
}

/* Adds a marker. outline: its colour, NULL: none. size_by: a QGIS expression for the size, NULL: `size`. */
static void add_marker(gis_text *to, const char *shape, const char *colour, const char *size, const char *size_by,
                       const char *outline)
{
    begin_layer(to, "SimpleMarker");
    add_property(to, "name", shape);
    add_property(to, "color", colour);
    add_property(to, "outline_style", outline ? "solid" : "no");
    if (outline) {
        add_property(to, "outline_color", outline);
        add_property(to, "outline_width", "0.4");
        add_property(to, "outline_width_unit", "MM");
    }
    add_property(to, "size", size);
    add_property(to, "size_unit", "MM");
    if (size_by) add_expression(to, "size", size_by);
    gis_text_print(to, "</layer>");
}

static const char *symbol_type(kind of) { return of == OF_POINTS ? "marker" : of == OF_LINES ? "line" : "fill"; }

static void begin_symbol(gis_text *to, const char *type, const char *name)
{
    gis_text_print(to, "<symbol name=\"%s\" type=\"%s\" alpha=\"1\" clip_to_extent=\"1\" force_rhr=\"0\">", name, type);
}

/* Adds a marker along a line: at its first or last vertex, as `placement` says, rotated with the line. */
static void add_marker_line(gis_text *to, const char *placement, const char *parent, const char *shape,
                            const char *colour, const char *size, const char *size_by, const char *outline)
{
    begin_layer(to, "MarkerLine");
    add_property(to, "placement", placement);
    add_property(to, "rotate", "1");
    char name[32];
    snprintf(name, sizeof name, "@%s@1", parent);
    begin_symbol(to, "marker", name);
    add_marker(to, shape, colour, size, size_by, outline);
    gis_text_print(to, "</symbol></layer>");
}

static void add_symbol(gis_text *to, kind of, const char *name, const char *colour, const char *outline)
{
    begin_symbol(to, symbol_type(of), name);
    if (of == OF_POINTS)
        add_marker(to, "circle", colour, "2", NULL, NULL);
    else if (of == OF_LINES)
        add_line(to, colour, "0.6");
    else
        add_fill(to, colour, outline, "solid");
    gis_text_print(to, "</symbol>\n");
}

/* Adds hatching in a direction to the features for which an expression is true. */
static void add_hatching(gis_text *to, const char *colour, const char *direction, const char *expression)
{
    begin_layer(to, "SimpleFill");
    add_property(to, "color", colour);
    add_property(to, "style", direction);
    add_property(to, "outline_style", "no");
    add_expression(to, "enabled", expression);
    gis_text_print(to, "</layer>");
}

/* Adds hatching to the features that have a smaller shape, and in the other direction to those with a larger one. */
static void add_hatchings(gis_text *to, const char *colour)
{
    add_hatching(to, colour, "b_diagonal", "coalesce(&quot;sunder_lvl&quot;, 0) &gt; 0");
    add_hatching(to, colour, "f_diagonal", "coalesce(&quot;sunder_cut&quot;, 0) &lt; 0");
}

/* Adds the fill of a status; hidden features have a dotted outline. rungs: features may have smaller shapes. */
static void add_status_fill(gis_text *to, const char *name, int status, const char *colour, const char *outline,
                            bool rungs)
{
    begin_symbol(to, "fill", name);
    add_fill(to, colour, outline, status == SUNDER_FEATURE_HIDDEN ? "dot" : "solid");
    if (rungs) add_hatchings(to, outline);
    gis_text_print(to, "</symbol>\n");
}

/* ---- Renderers --------------------------------------------------------------------------------------------------- */

/* Colours for the statuses in the field sunder_st, whose values are the core's words. */
static const struct {
    const char *colour, *outline;
} statuses[] = {
    [SUNDER_FEATURE_UNMOVED] = {"190,190,190,255", "130,130,130,255"},
    [SUNDER_FEATURE_MOVED] = {"27,158,119,255", "15,95,70,255"},
    [SUNDER_FEATURE_FIXED] = {"64,64,64,255", "20,20,20,255"},
    [SUNDER_FEATURE_BLOCKED] = {"215,25,28,255", "120,0,0,255"},
    [SUNDER_FEATURE_SKIPPED] = {"235,235,230,255", "190,190,185,255"},
    [SUNDER_FEATURE_HIDDEN] = {"255,255,255,0", "170,120,170,255"},
};
enum { STATUSES = SUNDER_FEATURE_HIDDEN }; /* without hiding */

static void add_by_status(gis_text *to, kind of, int n, bool rungs)
{
    gis_text_print(to,
                   "<renderer-v2 type=\"categorizedSymbol\" attr=\"sunder_st\" forceraster=\"0\" symbollevels=\"0\" "
                   "enableorderby=\"0\">\n<categories>\n");
    for (int i = 0; i < n; i++) {
        const char *word = sunder_feature_status_string((sunder_feature_status)i);
        gis_text_print(to, "<category value=\"%s\" label=\"%s\" symbol=\"%d\" render=\"true\"/>\n", word, word, i);
    }
    gis_text_print(to, "</categories>\n<symbols>\n");
    for (int i = 0; i < n; i++) {
        char name[12];
        snprintf(name, sizeof name, "%d", i);
        if (of == OF_POINTS)
            add_symbol(to, of, name, statuses[i].colour, statuses[i].outline);
        else
            add_status_fill(to, name, i, statuses[i].colour, statuses[i].outline, rungs);
    }
    gis_text_print(to, "</symbols>\n</renderer-v2>\n");
}

static void begin_single(gis_text *to)
{
    gis_text_print(to, "<renderer-v2 type=\"singleSymbol\" forceraster=\"0\" symbollevels=\"0\" enableorderby=\"0\">\n"
                       "<symbols>\n");
}

static void end_single(gis_text *to) { gis_text_print(to, "</symbols>\n</renderer-v2>\n"); }

/* Adds arrows with a head of fixed size, since moves are often shorter on the sheet than any arrow. */
static void add_arrows(gis_text *to)
{
    static const char blue[] = "31,78,200,255";
    begin_single(to);
    begin_symbol(to, "line", "0");
    add_line(to, blue, "0.4");
    add_marker_line(to, "lastvertex", "0", "filled_arrowhead", blue, "1.8", NULL, NULL);
    gis_text_print(to, "</symbol>\n");
    end_single(to);
}

/* Conditions on conflicts as QGIS expressions. A null reason is neither open nor allowed. */
#define IS_BARRIER "&quot;kind&quot; IN ('barrier','barrier_drawn','barrier_near')"
#define IS_OPEN "coalesce(&quot;reason&quot;,'') = 'unresolved'"
#define IS_ALLOWED "coalesce(&quot;reason&quot;,'') IN ('kept','same_block')"

/* The size of a conflict's disc: grows with `missing`, relative to the largest value in the layer. */
#define BY_MISSING "coalesce(1.8 + 1.6 * sqrt(&quot;missing&quot; / nullif(maximum(&quot;missing&quot;), 0)), 2.2)"

/* The rules for drawing conflicts: the label, the condition, the colour, and the symbol. */
static const struct {
    const char *label, *filter, *colour;
    bool open; /* the conflict is unresolved: a thin line and a ring */
} conflict_rules[] = {
    {"between features", "NOT (" IS_BARRIER ") AND NOT (" IS_OPEN ") AND NOT (" IS_ALLOWED ")", "231,0,138,255", false},
    {"between features, unresolved", "NOT (" IS_BARRIER ") AND (" IS_OPEN ")", "231,0,138,255", true},
    {"with a barrier", "(" IS_BARRIER ") AND NOT (" IS_OPEN ")", "106,27,154,255", false},
    {"with a barrier, unresolved", "(" IS_BARRIER ") AND (" IS_OPEN ")", "106,27,154,255", true},
    {"allowed", "NOT (" IS_BARRIER ") AND (" IS_ALLOWED ")", "150,150,150,255", false},
};
enum { CONFLICT_RULES = sizeof conflict_rules / sizeof *conflict_rules };

/* Adds the symbol of a conflict: a line, and a disc at one end, since the line between two features that touch has no
 * length and would not be seen. The disc grows with `missing`, from the smallest size that is visible to about twice
 * that. */
static void add_conflict_symbol(gis_text *to, int rule)
{
    const char *colour = conflict_rules[rule].colour;
    bool open = conflict_rules[rule].open;
    char name[12];
    snprintf(name, sizeof name, "%d", rule);
    begin_symbol(to, "line", name);
    add_line(to, colour, open ? "0.5" : "1.2");
    add_marker_line(to, "firstvertex", name, "circle", open ? "255,255,255,255" : colour, "2.2", BY_MISSING,
                    open ? colour : NULL);
    gis_text_print(to, "</symbol>\n");
}

/* The rule of tight pairs, and what takes these out of the rule of pairs of features. */
#define IS_TIGHT "&quot;kind&quot; = 'tight'"
#define NOT_TIGHT " AND NOT (" IS_TIGHT ")"

static void add_conflicts(gis_text *to, bool with_tight)
{
    gis_text_print(to, "<renderer-v2 type=\"RuleRenderer\" forceraster=\"0\" symbollevels=\"0\" "
                       "enableorderby=\"0\">\n<rules key=\"conflicts\">\n");
    for (int k = 0; k < CONFLICT_RULES; k++)
        gis_text_print(to, "<rule key=\"conflict %d\" symbol=\"%d\" label=\"%s\" filter=\"%s%s\"/>\n", k, k,
                       conflict_rules[k].label, conflict_rules[k].filter, with_tight && k == 0 ? NOT_TIGHT : "");
    if (with_tight)
        gis_text_print(to, "<rule key=\"tight\" symbol=\"%d\" label=\"tight\" filter=\"%s\"/>\n", CONFLICT_RULES,
                       IS_TIGHT);
    gis_text_print(to, "</rules>\n<symbols>\n");
    for (int k = 0; k < CONFLICT_RULES; k++) add_conflict_symbol(to, k);
    if (with_tight) {
        char name[12];
        snprintf(name, sizeof name, "%d", CONFLICT_RULES);
        begin_symbol(to, "line", name);
        add_line(to, "31,120,180,255", "0.5");
        gis_text_print(to, "</symbol>\n");
    }
    gis_text_print(to, "</symbols>\n</renderer-v2>\n");
}

/* Adds lines whose width grows with the force. They would cover the map, so the rule is switched off until the user
 * ticks it in the legend. */
static void add_pushes(gis_text *to)
{
    gis_text_print(to, "<renderer-v2 type=\"RuleRenderer\" forceraster=\"0\" symbollevels=\"0\" enableorderby=\"0\">\n"
                       "<rules key=\"pushes\">\n<rule key=\"push\" symbol=\"0\" label=\"what presses on what\" "
                       "checkstate=\"0\"/>\n</rules>\n<symbols>\n");
    begin_symbol(to, "line", "0");
    add_line_by(to, "106,61,154,255",
                "coalesce(0.3 + 2.2 * sqrt(&quot;force&quot; / nullif(maximum(&quot;force&quot;), 0)), 0.3)");
    gis_text_print(to, "</symbol>\n");
    end_single(to);
}

/* Adds lines whose width grows with the kink that the row has now, and a dot where each begins. */
static void add_rows(gis_text *to)
{
    static const char brown[] = "140,81,10,255";
    begin_single(to);
    begin_symbol(to, "line", "0");
    add_line_by(to, brown,
                "coalesce(0.2 + 1.0 * sqrt(&quot;kink_aft&quot; / nullif(maximum(&quot;kink_aft&quot;), 0)), 0.2)");
    add_marker_line(to, "firstvertex", "0", "circle", brown, "1", NULL, NULL);
    gis_text_print(to, "</symbol>\n");
    end_single(to);
}

static void add_plain(gis_text *to, kind of, const char *colour, const char *outline)
{
    begin_single(to);
    add_symbol(to, of, "0", colour, outline);
    end_single(to);
}

void gis_style_qml(gis_text *to, gis_style style, OGRwkbGeometryType type)
{
    kind of = kind_of(type);
    if (style == GIS_STYLE_NONE) return;
    gis_text_print(to, "<!DOCTYPE qgis PUBLIC 'http://mrcc.com/qgis.dtd' 'SYSTEM'>\n"
                       "<qgis version=\"3.22.0\" styleCategories=\"Symbology\">\n");
    switch (style) {
    case GIS_STYLE_NONE: break;
    case GIS_STYLE_STATUS: add_by_status(to, of, STATUSES, false); break;
    case GIS_STYLE_WITH_HIDDEN: add_by_status(to, of, STATUSES + 1, false); break;
    case GIS_STYLE_WITH_RUNGS: add_by_status(to, of, STATUSES + 1, true); break;
    case GIS_STYLE_DISPLACEMENT: add_arrows(to); break;
    case GIS_STYLE_CONFLICTS: add_conflicts(to, false); break;
    case GIS_STYLE_WITH_TIGHT: add_conflicts(to, true); break;
    case GIS_STYLE_PUSHES: add_pushes(to); break;
    case GIS_STYLE_ROWS: add_rows(to); break;
    case GIS_STYLE_HIDDEN: add_plain(to, of, "255,255,255,0", "170,120,170,255"); break;
    case GIS_STYLE_SYMBOLS: add_plain(to, of, "166,206,227,255", "31,78,120,255"); break;
    case GIS_STYLE_RESULT:
        if (of == OF_POLYGONS)
            add_plain(to, of, "166,206,227,255", "31,78,120,255");
        else
            add_plain(to, of, "231,0,138,255", "");
        break;
    }
    gis_text_print(to, "<blendMode>0</blendMode>\n<layerGeometryType>%d</layerGeometryType>\n</qgis>\n", (int)of);
}
