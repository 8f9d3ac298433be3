/* template.h: the files of page/, as the build puts them into the program (embed.cmake). */
#ifndef GIS_REPORT_TEMPLATE_H
#define GIS_REPORT_TEMPLATE_H

extern const char gis_template_page[];  /* page.html: HTML with slots, {{name}} */
extern const char gis_template_style[]; /* page.css */
extern const char gis_template_script[];
/* Of the two, as a content security policy names them: "sha256-" and the hash in base 64. */
extern const char gis_template_style_hash[], gis_template_script_hash[];

#endif
