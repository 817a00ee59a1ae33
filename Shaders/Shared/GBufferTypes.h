// Constants of the raster G-buffer, shared by C++ and GLSL.
#ifndef LANTERN_GBUFFER_TYPES_H
#define LANTERN_GBUFFER_TYPES_H

#include "SceneTypes.h"

LANTERN_SHARED_BEGIN

struct FGBufferConstants
{
	FPassConstants Pass;
	FAddress Objects; // uint[]: object index of each instance of the draw
	uint Section;     // index of the section within each of these objects
	uint bLayers;     // rays show what light shines through, and blended surfaces where they are not solid
};
LANTERN_ASSERT_SIZE(FGBufferConstants, 32);

LANTERN_SHARED_END

#endif
