/* layer_calls.c */
#include "python/extension.h"
PyMethodDef gis_py_layer_functions[] = {{NULL, NULL, 0, NULL}};
