// Who casts shadows on whom: the instance masks of rays from a surface to a light.
#ifndef LANTERN_CASTERS_GLSL
#define LANTERN_CASTERS_GLSL

#include "../Shared/SceneTypes.h"
#include "Bindings.glsl"
#include "HostNumbers.glsl"

// bCharacter: the surface is a character's. Raster shadow maps hold characters apart for this: faces have no self-shadow.
uint SunCasters(bool bCharacter) { return bCharacter ? MASK_SUN_CASTERS & ~MASK_CHARACTER : MASK_SUN_CASTERS; }
#ifdef ONE_CASTER // r.RT.Debug.Lights.Casters
uint LocalCasters(bool bCharacter) { return SunCasters(bCharacter); }
#else
uint LocalCasters(bool bCharacter) { return bCharacter ? MASK_LOCAL_CASTERS & ~MASK_CHARACTER : MASK_LOCAL_CASTERS; }
#endif

#ifdef HAS_CHARACTERS
// Whether a pixel shows a character: by FGBuffer::Classes, or by the object that FGBuffer::Motion names.
bool IsCharacterPixel(FSceneConstants Scene, uint Classes, uint ClassesOffset, uint Motion, ivec2 Pixel)
{
#ifdef ONE_RECEIVER // r.RT.Debug.Shadow.Receivers
	return false;
#endif
	if (Classes != NO_TEXTURE) { return (LoadHostNumber(Classes, ClassesOffset, Pixel) & CLASS_CHARACTER) != 0u; }
	if (Motion == NO_TEXTURE) { return false; }
	float Object = texelFetch(Textures[Motion], Pixel, 0).w;
	return Object >= 1.0 && (FObjectRef(Scene.Objects).Data[uint(Object) - 1u].Flags & OBJECT_CHARACTER) != 0u;
}
#endif

#endif
