/* template.h: the files of template/, which the build embeds in the program (embed.cmake). */
#ifndef GIS_PAGE_TEMPLATE_H
#define GIS_PAGE_TEMPLATE_H

extern const char gis_template_page[];  /* page.html: HTML with slots {{name}} */
extern const char gis_template_style[]; /* page.css */
extern const char gis_template_script[];
/* The hashes of style and script in the form of a content security policy: "sha256-" and the hash in base 64. */
extern const char gis_template_style_hash[], gis_template_script_hash[];

#endif
