// Who casts shadows on whom: the instance masks of rays from a surface to a light.
#ifndef LANTERN_CASTERS_GLSL
#define LANTERN_CASTERS_GLSL

#include "../Shared/SceneTypes.h"

// bCharacter: the surface is a character's. Raster shadow maps hold characters apart for this: faces have no self-shadow.
uint SunCasters(bool bCharacter) { return bCharacter ? MASK_SUN_CASTERS & ~MASK_CHARACTER : MASK_SUN_CASTERS; }
uint LocalCasters(bool bCharacter) { return bCharacter ? MASK_LOCAL_CASTERS & ~MASK_CHARACTER : MASK_LOCAL_CASTERS; }

#endif
