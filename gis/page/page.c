/* page.c: see page.h. It writes the template; a section of another file fills each slot. */
#include "page/page.h"

#include "page/map_data.h"
#include "page/pictures.h"
#include "page/sections.h"
#include "page/template.h"

#include <string.h>

static bool add_before(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    return gis_page_add_overview(model, false, to, error);
}

static bool add_after(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    return gis_page_add_overview(model, true, to, error);
}

/* A slot is filled by a constant text, or by the function that writes a section. */
static const struct {
    const char *name;
    const char *text;
    gis_page_section *section;
} slots[] = {
    {"style", gis_template_style, NULL},
    {"style-hash", gis_template_style_hash, NULL},
    {"script", gis_template_script, NULL},
    {"script-hash", gis_template_script_hash, NULL},
    {"title", NULL, gis_page_title},
    {"lede", NULL, gis_page_lede},
    {"figures", NULL, gis_page_figures},
    {"before", NULL, add_before},
    {"after", NULL, add_after},
    {"legend", NULL, gis_page_legend},
    {"map-note", NULL, gis_page_map_note},
    {"map-data", NULL, gis_map_data_write},
    {"places", NULL, gis_page_places},
    {"moves", NULL, gis_page_moves},
    {"rows", NULL, gis_page_rows},
    {"blocked", NULL, gis_page_blocked},
    {"hidden", NULL, gis_page_hidden},
    {"certificate", NULL, gis_page_certificate},
    {"sheet", NULL, gis_page_sheet},
    {"colophon", NULL, gis_page_colophon},
};

static bool fill_slot(const char *name, size_t n, const gis_page_model *model, const gis_thinning *thinning,
                      gis_text *to, gis_error *error)
{
    for (size_t k = 0; k < sizeof slots / sizeof *slots; k++) {
        if (strlen(slots[k].name) != n || memcmp(slots[k].name, name, n) != 0) continue;
        if (slots[k].section) return slots[k].section(model, thinning, to, error);
        gis_text_add(to, slots[k].text);
        return true;
    }
    return gis_fail(error, "--report: the page has a slot %.*s that nothing fills", (int)n, name);
}

static bool fill_all(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    const char *rest = gis_template_page;
    for (const char *slot; (slot = strstr(rest, "{{")) != NULL;) {
        const char *name = slot + 2, *end = strstr(name, "}}");
        gis_text_add_bytes(to, rest, (size_t)(slot - rest));
        if (!end || !fill_slot(name, (size_t)(end - name), model, thinning, to, error)) return false;
        rest = end + 2;
    }
    gis_text_add(to, rest);
    return gis_text_get(to) || gis_no_memory(error);
}

bool gis_page_write(const gis_page_request *request, gis_text *to, gis_error *error)
{
    gis_page_model model;
    gis_thinning thinning = {0};
    bool ok = gis_page_model_make(request, &model, error) && gis_thinning_choose(&model, &thinning, error) &&
              fill_all(&model, &thinning, to, error);
    gis_thinning_clear(&thinning);
    gis_page_model_clear(&model);
    return ok;
}
