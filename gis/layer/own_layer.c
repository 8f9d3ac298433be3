/* own_layer.c: the layer that a feature belongs to, if several layers move together, and what layers are called. */
#include "layer/layer_input.h"

const gis_layer_input *gis_layer_own(const gis_layer_input *input, size_t *i)
{
    size_t k = input->parts;
    if (k == 0) return input;
    while (--k > 0 && input->part[k].first > *i) continue;
    *i -= input->part[k].first;
    return &input->part[k];
}

size_t gis_layer_sources(const gis_layer_input *input) { return input->parts ? input->parts : 1; }

const gis_source *gis_layer_source(const gis_layer_input *input, size_t k)
{
    return input->parts ? input->part[k].source : input->source;
}

const char *gis_layer_name(const gis_layer_input *input)
{
    return input->request->name ? input->request->name : gis_source_name(input->source);
}

const char *gis_layer_title(const gis_layer_input *input)
{
    return input->parts ? input->request->title : gis_source_name(input->source);
}
