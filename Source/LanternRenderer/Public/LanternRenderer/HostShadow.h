// The host's shadow map of the sun. Rays leave to it what it knows well, and trace the rest.
#pragma once

#include <array>

#include "HostShadowTypes.h"
#include "LanternCore/FrameGraph/FrameGraph.h"
#include "LanternCore/Shaders/ShaderCompiler.h"

namespace Lantern
{

/// What the sun sees of a part of the world, by an orthographic projection.
struct FHostShadowCascade
{
	FGraphTexture Map; ///< a depth format or R32_FLOAT; reversed or not, as WorldToMap says
	/// The cascade's part of the texture, texels. Width and Height 0: to the texture's end.
	uint32_t OffsetX = 0, OffsetY = 0, Width = 0, Height = 0;
	/// Three rows of four, which take a position in the world in metres. The first two give x and y from 0 to 1 over that part, y
	/// downwards. The third gives depth as texels have it. Casters beyond the near plane are clamped to it.
	double WorldToMap[12] = {};
	float TexelSize = 0.0f; ///< of the world on the map, metres, > 0
	/// Distance by which a texel may be nearer to the sun than the surface that it shows, metres, ≥ 0. The surface's slope is no part of it.
	float DepthBias = 0.0f;
};

/// Rays trace the casters that are not Held. What is Held comes from the map, where it is surely lit or surely dark. Where it is neither,
/// rays trace these casters as well. Maps of HOST_SHADOW_OTHERS count everywhere instead, since rays cannot meet all that they hold.
struct FHostShadow
{
	/// Ordered from the finest to the coarsest. All hold the same casters, each in its own part of the world.
	std::array<FHostShadowCascade, HOST_SHADOW_CASCADES> Cascades;
	uint32_t CascadeCount = 0;
	/// Casters on the map: bits of instance masks (MASK_SUN, MASK_SUN_MOVING, MASK_CHARACTER), and HOST_SHADOW_OTHERS.
	uint32_t Held = 0;
	/// Address of any data, read by a host's own Tiles/HostShadow.glsl, which needs no cascades.
	FAddress ShaderData = 0;
	bool IsGiven() const { return CascadeCount > 0 || ShaderData != 0; }
};

/// Returns the header by which a host's own file takes the place of Tiles/HostShadow.glsl, for FRendererDesc::ShaderHeaders. Path:
/// absolute, or relative to FRendererDesc::ShaderFolders, and none called Tiles/HostShadow.glsl.
FShaderHeader MakeHostShadowHeader(const std::string& Path);
/// Whether that header is among them.
bool HasHostShadowHeader(const std::vector<FShaderHeader>& Headers);

} // namespace Lantern
