/* feature_name.c: see layer_input.h. */
#include "layer/layer_input.h"

#include "base/message.h"

void gis_feature_name(const gis_layer_input *input, size_t i, char *text, size_t size)
{
    input = gis_layer_own(input, &i);
    GIntBig fid = gis_source_fid(input->source, i);
    OGRFeatureH feature = input->id_field >= 0 ? gis_source_attributes(input->source, i) : NULL;
    bool has_id = feature && OGR_F_IsFieldSetAndNotNull(feature, input->id_field);
    const gis_subject subject = {
        NULL, gis_source_name(input->source),      fid != OGRNullFID,
        fid,  gis_source_first(input->source) + i, has_id ? OGR_F_GetFieldAsString(feature, input->id_field) : NULL};
    gis_name_subject(&subject, text, size);
}
