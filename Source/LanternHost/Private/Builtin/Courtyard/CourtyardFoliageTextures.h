// Alpha-tested leaf textures: sprays of leaves on a transparent ground, drawn by code.
#pragma once

#include "Builtin/SceneBuilder.h"

namespace Lantern::Builtin
{

enum class ELeafKind
{
	Broad,
	Ivy,
	Needle,
	Flower
};

/// Double-sided and alpha-masked. Unit texture coordinates put the stem at the bottom middle.
int32_t AddLeafMaterial(FSceneBuilder& Builder, ELeafKind Kind);

} // namespace Lantern::Builtin
