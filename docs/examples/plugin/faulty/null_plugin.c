/* Has no plugin to give. */
#include "faulty.h"

const rastercheck_plugin* rastercheck_plugin_get(void) { return NULL; }
