/* read.c: reads the layer that is dilated or eroded, and the shape. The layer is read first, since its CRS defines the
 * units of lengths in the shape. */
#include "buffer/buffer.h"

#include "base/message.h"
#include "read/fields.h"

#include <stdlib.h>

bool gis_buffer_read(const gis_buffer_request *request, gis_buffer *out, gis_error *error)
{
    gis_layer_input *input = &out->input;
    *out = (gis_buffer){.request = request, .field = -1};
    if (!gis_layer_shapes_read(&request->layer, input, error) ||
        !gis_field_find(input->source, "--dissolve-field", request->dissolve_field, &out->field, error) ||
        !gis_shape_read(&request->shape, &input->units, gis_source_crs(input->source), &out->shape_source, &out->shape,
                        error))
        return false;
    gis_layer_warn_of_crs(input);
    if (input->other > 0)
        gis_say_warning(GIS_MESSAGE_PASSED_BY, "%s: %zu features are not polygons; they are written without geometry",
                        gis_source_name(input->source), input->other);
    return gis_buffer_gather(out, error);
}

void gis_buffer_clear(gis_buffer *buffer)
{
    for (size_t k = 0; k < buffer->sets; k++) gis_buffer_set_clear(&buffer->set[k]);
    free(buffer->set);
    free(buffer->member);
    sunder_shape_free(buffer->shape);
    gis_source_close(buffer->shape_source);
    gis_layer_input_clear(&buffer->input);
}
