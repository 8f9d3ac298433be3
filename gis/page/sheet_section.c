/* sheet_section.c: the specification of a run, as the pages show it. */
#include "page/sections.h"

#include "page/escape.h"

#include <json-c/json.h>

bool gis_page_add_sheet(const char *sheet, gis_text *to, gis_error *error)
{
    if (!sheet) return true;
    struct json_object *object = json_tokener_parse(sheet);
    if (!object) return gis_no_memory(error);
    gis_text_add(to, "<details><summary>Specification</summary>\n<pre>");
    gis_escape_markup(to, json_object_to_json_string_ext(object, JSON_C_TO_STRING_PRETTY | JSON_C_TO_STRING_SPACED |
                                                                     JSON_C_TO_STRING_NOSLASHESCAPE));
    gis_text_add(to, "</pre></details>\n");
    json_object_put(object);
    return true;
}

bool gis_page_sheet(const gis_page_model *model, const gis_thinning *thinning, gis_text *to, gis_error *error)
{
    (void)thinning;
    return gis_page_add_sheet(model->request->input->request->sheet, to, error);
}
