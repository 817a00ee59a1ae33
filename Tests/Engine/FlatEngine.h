// An engine that draws nothing but a floor, so that its G-buffer is constant: for pictures of what rays alone see.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "LanternModule/Module.h"
#include "Support/StatusChecks.h"

namespace Lantern
{

/// Signals of one frame, as the engine reads them.
struct FSignalPicture
{
	std::map<ESignal, std::vector<float>> Signals; ///< rgb or one channel, row by row
	/// Largest difference of any value, and the mean difference over the mean value.
	double GetLargestDifference(const FSignalPicture& Other) const;
	double GetMeanDifference(const FSignalPicture& Other) const;
	double GetMean(ESignal Signal) const;
};

/// The floor is y = 0, seen from CameraHeight above the origin; a picture is 4 m wide.
class FFlatEngineTest : public testing::Test
{
protected:
	static constexpr uint32_t Size = 48;
	static constexpr double CameraHeight = 2.0;

	void SetUp() override;
	void TearDown() override;
	/// Makes a renderer, fills its scene by Fill, and returns the sixth frame. All of the scene must be there by then.
	FSignalPicture Render(const std::function<void(IRTModuleRenderer&)>& Fill, const FSignalSet& Wanted);
	/// Called before frame Index of each picture; may be empty.
	std::function<void(IRTModuleRenderer& Renderer, int Index)> BeforeFrame;
	/// Changes what is handed to the plugin; may be empty.
	std::function<void(FRTModuleFrame&)> ChangeFrame;
	/// A buffer with Bytes in it, imported as an engine's.
	TRTRef<IRTBuffer> ImportBytes(const std::vector<uint8_t>& Bytes, const char* Name);
	/// A texture with these texels, in ShaderRead.
	TRTRef<IRTTexture> MakeTexture(const FRTTextureDesc& Desc, const void* Texels);
	void SetVariable(const char* Name, const char* Value) { ASSERT_OK(Module->SetConsoleVariable(Name, Value)); }
	/// Adds an object of the mesh with the material.
	static ERTObjectHandle Place(IRTModuleRenderer& Renderer, ERTMeshHandle Mesh, ERTMaterialHandle Material, glm::dvec3 At, double Scale);

	/// Adds a mesh: a level square of 2 · Half metres about the axis.
	static ERTMeshHandle AddSquare(IRTModuleRenderer& Renderer, float Half, float Height);
	static constexpr double LampCandela = 100.0;
	/// Adds a lamp above or below the floor's middle, and a sun of 4 lux that shines straight from its side. LampHeight: metres, not 0.
	static void AddVerticalLights(IRTModuleRenderer& Renderer, double LampHeight);
	/// Means of the left and of the right half, of one channel.
	static std::pair<double, double> GetHalves(const FSignalPicture& Picture, ESignal Signal);

	FRTModuleRendererDesc RendererDesc; ///< of renderers that Render makes
	TRTRef<IRTModule> Module;
	TRTRef<IRTDevice> Device;
	TRTRef<IRTTexture> Depth, Normals, BaseColor, Material;
	TRTRef<IRTTexture> Classes;           ///< null: the engine has none
	std::vector<TRTRef<IRTBuffer>> Owned; ///< the engine's memory behind imported buffers

private:
	FRTModuleFrame DescribeFrame() const;
	void RenderFrame(IRTModuleRenderer& Renderer, FRTModuleFrame Frame, FSignalPicture* Out);
	void Read(IRTCommandList& List, const FRTModuleOutputs& Outputs, const FSignalSet& Wanted);
	std::map<ESignal, TRTRef<IRTBuffer>> Readbacks;
};

} // namespace Lantern
