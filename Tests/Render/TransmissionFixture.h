// What tests of glass share: its material, and a wall to look at through it.
#pragma once

#include "Support/TestScene.h"

namespace Lantern
{

constexpr double GlassR = 0.04; ///< reflectance of an interface of ior 1.5

inline FHostMaterial MakeGlass(bool bSolid = false, float Ior = 1.5f)
{
	FHostMaterial Glass;
	Glass.Metallic = 0.0f;
	Glass.Roughness = 0.0f;
	Glass.Transmission = 1.0f;
	Glass.Ior = Ior;
	Glass.bSolid = bSolid;
	Glass.bDoubleSided = true;
	return Glass;
}

/// A square of 2 · Half metres that faces +z.
inline FTestScene::FQuad MakeWall(int32_t Material, float Half, float Z)
{
	return {Material, {{-Half, -Half, Z}, {Half, -Half, Z}, {Half, Half, Z}, {-Half, Half, Z}}};
}

} // namespace Lantern
