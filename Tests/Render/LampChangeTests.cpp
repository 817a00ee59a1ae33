// Lamps that change, as the filter follows them; and the draws of regions with more lamps than they list.
#include <cmath>

#include "SignalFixture.h"

namespace Lantern
{

namespace
{
class FLampChangeTest : public FSignalTest
{
protected:
	/// A bare floor under lamps, of which tiles have many.
	void LoadFloor()
	{
		FTestScene Scene("floor");
		Scene.AddNode(Scene.AddMesh({FTestScene::MakeFloor(Scene.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		ASSERT_TRUE(Load(std::move(Scene.Scene)));
		SetSun(0.0, 0.0f);
		SetSky(glm::vec3(0));
		SetVariable("r.RT.Lights.Exact", "1");
	}
	static FRTScene& GetWorld() { return GetScene().GetScene(); }
	static FSceneLight MakeLamp(glm::dvec3 Position, float Candela)
	{
		FSceneLight Light;
		Light.Position = Position;
		Light.Color = glm::vec3(Candela);
		return Light;
	}
	/// Mean over the picture of a filtered frame. bCut: the first one.
	double Play(uint32_t Frames, bool bCut)
	{
		double Mean = 0.0;
		for (uint32_t Frame = 0; Frame < Frames; ++Frame)
		{
			FView View = LookAt({0, 3, 0.01}, {0, 0, 0}, 0.6f, 48, 32);
			View.bCut = bCut && Frame == 0;
			FFrameCapture Capture;
			Capture.Signals.Add(ESignal::LocalDiffuse);
			FCapturedFrame Captured;
			EXPECT_OK(GetEngine().RenderFrame(View, 0.0, Capture, &Captured));
			Mean = MeanGreen(Captured.Get(ESignal::LocalDiffuse));
		}
		return Mean;
	}
};

// The table ends before a lamp that was its last: another one is not taken for it, though it is where that was.
TEST_F(FLampChangeTest, TheLastLampOfManyGoesDarkAtOnce)
{
	ASSERT_NO_FATAL_FAILURE(LoadFloor());
	for (int I = 0; I < 6; ++I) { (void)GetWorld().AddLight(MakeLamp({0.2 * I, 1.5, 0}, 0.05f)); }
	(void)GetWorld().AddLight(MakeLamp({0, 2, 0}, 10.0f));
	const FLightId Last = GetWorld().AddLight(MakeLamp({0, 2, 0}, 10.0f));
	const double Both = Play(32, true);
	GetWorld().RemoveLight(Last);
	const double One = Play(1, false);
	PrintFigure(fmt::format("mean light {:.4f}, without its last lamp {:.4f}", Both, One));
	EXPECT_NEAR(One / Both, 0.5, 0.1);
}

// More than are followed, and brighter than a variance in fp16 can say: the history is given up.
TEST_F(FLampChangeTest, ManyBrightLampsThatChangeLeaveNoHistory)
{
	ASSERT_NO_FATAL_FAILURE(LoadFloor());
	std::vector<FLightId> Ids;
	for (int I = 0; I < 80; ++I) { Ids.push_back(GetWorld().AddLight(MakeLamp({0.3 * (I % 9) - 1.2, 1.5, 0.3 * (I / 9) - 1.2}, 4e3f))); }
	const double Bright = Play(32, true);
	for (const FLightId Id : Ids)
	{
		FSceneLight Light = GetWorld().GetLights().Get(Id);
		Light.Color *= 0.1f;
		GetWorld().SetLight(Id, Light);
	}
	const double Dim = Play(1, false);
	PrintFigure(fmt::format("mean light {:.1f}, with a tenth of each lamp {:.1f}", Bright, Dim));
	EXPECT_NEAR(Dim / Bright, 0.1, 0.02);
}

using FLightRegionsTest = FRenderTest;

// Whatever the offset is, the whole of the weights has all draws: else entries of the list are what memory held before.
TEST_F(FLightRegionsTest, NoDrawIsLeftOver)
{
	constexpr const char* Shader = R"(#version 460
#include "Shared/SceneTypes.h"
#include "LocalLights/Regions.glsl"
layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FOutput { uint Data[]; };
layout(push_constant, scalar) uniform FPush { FAddress Output; };
void main()
{
	float Offset = 1.0 - float(gl_LocalInvocationIndex + 1u) * (1.0 / 16777216.0), All = 0.1 + float(gl_WorkGroupID.x) * 0.37;
	FOutput(Output).Data[gl_GlobalInvocationID.x] = DrawsBelow(All, All, Offset, 128u);
}
)";
	constexpr uint32_t Groups = 16, Count = 64 * Groups;
	IRTPipeline* Pipeline = nullptr;
	const FShaderSource Source{"RegionDrawsTest.comp", ERTShaderStage::Compute, {}, Shader};
	ASSERT_OK(GetEngine().GetRenderer().GetPipelines().Get(Source, Pipeline));
	TRTRef<IRTBuffer> Results;
	ASSERT_OK(GetDevice().CreateBuffer(
	    {Count * sizeof(uint32_t), ERTBufferUsage::Storage, ERTMemory::Readback, "Draws"}, Results.ReleaseAndGetAddress()));
	const uint64_t Push = Results->GetDeviceAddress();
	Dispatch(Pipeline, &Push, sizeof(Push), Groups, 1, Results.Get());
	const auto* const Draws = static_cast<const uint32_t*>(Results->GetMapped());
	for (uint32_t I = 0; I < Count; ++I) { ASSERT_EQ(Draws[I], 128u) << I; }
}

} // namespace
} // namespace Lantern
