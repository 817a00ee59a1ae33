// An engine's deferred renderer in conventions that tests choose: it draws triangles into a G-buffer and describes it to the plugin.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "LanternCore/Shaders/ShaderCompiler.h"
#include "LanternModule/Module.h"
#include "TriangleTruth.h"

namespace Lantern
{

struct FEngineCamera
{
	glm::dvec3 Position{0}, Forward{0, 0, -1}, Up{0, 1, 0};
	double FovY = 1.0;
};

enum class EEngineNormals : uint8_t
{
	Native, ///< both, RGBA16_SNORM
	View,   ///< one shading normal, in view space, RGBA8_UNORM
	World,  ///< one shading normal, in the world, RGB10A2_UNORM
};

/// What an engine does its own way. Default: what Lantern calls native.
struct FEngineConventions
{
	const char* Name = "native";
	ERTFormat DepthFormat = ERTFormat::D32_FLOAT;
	bool bReversed = true;
	double Near = 0.05, Far = 0.0; ///< Far 0: infinite, only if reversed
	glm::vec2 Jitter{0};           ///< pixels
	bool bLinearDepth = false;     ///< R32_FLOAT, distance along the view, instead of DepthFormat
	EEngineNormals Normals = EEngineNormals::Native;
	ERTFormat MotionFormat = ERTFormat::Unknown; ///< Unknown: the plugin gets no motion
	bool bMaterials = false;                     ///< base colour and material are handed over
	bool bUnrealMaterial = false;                ///< they are as Unreal's
	ESignal Signal = ESignal::SunShadow;         ///< what is wanted and read back
	/// What the plugin is told; motion is stored accordingly.
	FRTModuleGBufferLayout Layout;
	bool bClipYUp = false;
	bool bOrthographic = false;
	double OrthographicHeight = 10.0; ///< metres
	/// Depth is left read-only and normals in the general layout, as their last use had them, and are wanted back so.
	bool bExternal = false;
	glm::uvec2 Offset{0}; ///< of the view in its textures, which are larger by as much and half as much again
};

/// One frame's textures, and which triangle each pixel shows: its index + 1; 0: sky.
class FEngineRaster
{
public:
	explicit FEngineRaster(IRTDevice& InDevice);
	FRTStatus SetScene(const FTriangleSoup& Soup);
	/// Draws, records a frame of Renderer after it, runs it and waits. OutVisibility: the signal, one value for each pixel.
	FRTStatus Render(IRTModuleRenderer& Renderer, const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size,
	    std::vector<float>& OutVisibility, std::vector<uint32_t>& OutTriangles);
	/// The camera of the frame before, and where all triangles are now and were then, for motion.
	std::optional<FEngineCamera> Previous;
	glm::dvec3 Shift{0}, PreviousShift{0};
	/// Changes what is handed to the plugin; may be empty.
	std::function<void(FRTModuleFrame&)> Change;
	bool IsComplete() const { return bComplete; }

	/// The projection that the raster draws with, without jitter, and as the plugin is told.
	static FRTModuleProjection MakeProjection(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size);
	/// A camera ray of double precision through a point of the picture.
	static void MakeRay(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size, glm::dvec2 Pixel, glm::dvec3& OutOrigin,
	    glm::dvec3& OutDirection);

	static constexpr size_t ColorCount = 7;

private:
	struct FTargets
	{
		TRTRef<IRTTexture> Depth, Colors[ColorCount];
		TRTRef<IRTBuffer> Frame;
		TRTRef<IRTTexture> Imported[2]; ///< Depth and normals, if the engine has layouts of its own
	};
	static FRTModuleFrame DescribeFrame(
	    const FTargets& Targets, const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size);
	FRTStatus CreatePipeline(const FEngineConventions& As, TRTRef<IRTPipeline>& Out);
	FRTStatus CreateTargets(const FEngineConventions& As, glm::uvec2 Size, FTargets& Out);
	FRTStatus WriteFrame(const FEngineCamera& Camera, const FEngineConventions& As, glm::uvec2 Size, FTargets& Targets) const;
	void Draw(IRTCommandList& List, IRTPipeline* Pipeline, const FTargets& Targets, const FEngineConventions& As, glm::uvec2 Size);
	/// Imports depth and normals, moves them to the engine's own layouts, and says so in Frame.
	FRTStatus MoveToOwnLayouts(IRTCommandList& List, FTargets& Targets, FRTModuleFrame& Frame);
	FRTStatus ReadBack(IRTCommandList& List, IRTTexture* Texture, uint32_t TexelBytes, TRTRef<IRTBuffer>& Out);

	IRTDevice& Device;
	FShaderCompiler Compiler;
	TRTRef<IRTBuffer> Positions, Normals;
	uint32_t VertexCount = 0;
	bool bComplete = false;
};

} // namespace Lantern
