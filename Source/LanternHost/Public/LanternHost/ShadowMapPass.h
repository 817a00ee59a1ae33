// The sample engine's shadow map of the sun: cascades around the camera, as engines have them.
#pragma once

#include <array>

#include "LanternHost/DrawList.h"

namespace Lantern
{

/// r.RT.HostShadow and the variables beside it say which casters the map holds, and how fine it is. Cascades are spheres around
/// slices of the view, and move by whole texels, so that shadows do not crawl as the camera moves (Valient 2008).
class FShadowMapPass
{
public:
	explicit FShadowMapPass(FRenderer& InRenderer) : Renderer(InRenderer) {}
	/// Whether frames hand a map over.
	static bool IsOn();
	/// Compiles what frames will draw the scene with, and waits for it. For load time, between frames.
	FRTStatus Precache(FHostScene& Scene);
	/// Adds the raster passes of the map, and returns it for FFrameContext::HostShadow. Without a sun, or while a pipeline is being compiled,
	/// it is not given. Context and Scene must live until the frame's EndFrame. One call a frame.
	FHostShadow Add(FFrameContext& Context, FHostScene& Scene);

private:
	using FPipelineKey = std::pair<uint32_t, bool>; // program and alpha test
	struct FCascade
	{
		glm::dmat3 Axes; ///< columns: right, down and forward of the map
		glm::dvec2 Center{0};
		double Radius = 0.0, Near = 0.0, Far = 0.0; ///< metres; near and far along the light from the world's origin
	};
	IRTPipeline* Ask(const FFrameContext& Context, uint32_t Program, bool bMasked);
	static std::set<FPipelineKey> ListKeys(const FHostScene& Scene, const FSceneFacts& Facts);
	bool FindPipelines(const FFrameContext& Context, const FHostScene& Scene);
	FCascade PlaceCascade(const FFrameContext& Context, const FHostScene& Scene, double Begin, double End, uint32_t Resolution) const;
	void AddCascade(FFrameContext& Context, FHostScene& Scene, const FCascade& Cascade, FDrawList& Draws, FGraphTexture Map);

	FRenderer& Renderer;
	std::map<FPipelineKey, IRTPipeline*> Pipelines; // of the frame that is being made
	std::vector<uint8_t> Masks;                     // by index of the object
	std::array<FDrawList, HOST_SHADOW_CASCADES> Lists;
};

} // namespace Lantern
