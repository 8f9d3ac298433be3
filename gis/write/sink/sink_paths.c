/* sink_paths.c: names of the files and layers of a sink, and tests whether a path exists. */
#define _LARGEFILE64_SOURCE /* cpl_vsi.h needs struct stat64 */
#include "base/path.h"
#include "write/sink/sink_internal.h"

#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <string.h>

char *gis_sink_inside(const gis_sink *sink, const char *file)
{
    if (sink->place == GIS_PLACE_DATABASE) return CPLStrdup(sink->request.path);
    return sink->memory ? gis_printed("%s/%s", sink->memory, file) : gis_stage_inside(sink->stage, file);
}

char *gis_sink_name_for(const gis_sink *sink, const char *suffix)
{
    const char *prefix = sink->request.prefix;
    return suffix[0] ? gis_printed("%s_%s", prefix ? prefix : sink->request.main_layer, suffix)
                     : CPLStrdup(sink->request.main_layer);
}

char *gis_sink_name_of(const gis_sink *sink, const gis_sink_layer_request *request)
{
    const char *suffix = request->suffix,
               *main = request->main ? sink->request.more[request->main - 1].name : sink->request.main_layer;
    if (!request->like_source) return gis_sink_name_for(sink, suffix);
    return gis_printed("%s%s%s", main, suffix[0] ? "_" : "", suffix);
}

static const char *double_ending(const char *name)
{
    size_t length = strlen(name);
    return length > 8 && EQUAL(name + length - 8, ".shp.zip") ? name + length - 8 : NULL;
}

char *gis_sink_file_for(const gis_sink *sink, const char *suffix)
{
    const char *name = gis_path_name(sink->request.path);
    const char *ending = double_ending(name);
    if (!ending) ending = strrchr(name, '.');
    if (!ending) ending = name + strlen(name);
    if (!suffix[0]) return CPLStrdup(name);
    return gis_printed("%.*s_%s%s", (int)(ending - name), name, suffix, ending);
}

bool gis_sink_exists(const char *path)
{
    VSIStatBufL status;
    return VSIStatExL(path, &status, VSI_STAT_EXISTS_FLAG) == 0;
}

bool gis_sink_is_directory(const char *path)
{
    VSIStatBufL status;
    return VSIStatExL(path, &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_NATURE_FLAG) == 0 && VSI_ISDIR(status.st_mode);
}
