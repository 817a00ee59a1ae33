// Whose material program rays run: what only lights is seen as the standard program shows it, and what is seen runs its own.
#include "SignalFixture.h"

namespace Lantern
{

namespace
{
constexpr glm::vec3 StandardColor{0.8f};
constexpr uint32_t Frames = 32;

class FHitProgramsTest : public FSignalTest
{
protected:
	void SetUp() override
	{
		FSignalTest::SetUp();
		SetVariable("r.RT.GI", "3");
		SetVariable("r.RT.GI.Path", "1"); // ray queries know the standard program alone
		SetVariable("r.RT.Reflections", "1");
		SetVariable("r.RT.Reflections.Path", "1");
		SetVariable("r.RT.GI.Cells.Capacity", "65536"); // pictures here have few pixels
		FTestScene Room("program and mirror");
		FHostMaterial Silver;
		Silver.Roughness = 0.0f;
		const int32_t Wall = Room.AddLambert(StandardColor, glm::vec3(0), true),
		              Floor = Room.AddLambert(glm::vec3(0.7f), glm::vec3(0), true), Mirror = Room.AddMaterial(Silver);
		Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Floor, 3.0f)}));
		Room.AddNode(Room.AddMesh({{Wall, {{-2, 0, 3}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 3}}}}));
		Room.AddNode(Room.AddMesh({{Mirror, {{-2, 0.2f, -2}, {2, 0.2f, -2}, {2, 2.5f, -2}, {-2, 2.5f, -2}}}}));
		ASSERT_TRUE(Load(std::move(Room.Scene)));
		SetSun(10.0, 4.0f, {-1.0, -0.4, -0.1});
		SetSky(glm::vec3(0));
		const uint32_t Program = GetEngine().GetRenderer().GetPrograms().Add({.Name = "Painted", .Text = R"(
#include "Standard.glsl"
FMaterialSurface EvaluateMaterial(FMaterialData M, FMaterialInputs I, uint Override)
{
	FMaterialSurface S = EvaluateStandard(M, I, Override);
	S.BaseColor = vec3(0.8, 0.0, 0.0);
	return S;
}
)"});
		GetScene().GetScene().SetMaterialProgram(static_cast<uint32_t>(Wall), Program);
		View = LookAt({0.5, 1.6, 3.5}, {-0.5, 0.5, -1}, 1.0f, 96, 64);
	}
	FImage RenderLast(ESignal Signal)
	{
		FFrameCapture Capture;
		Capture.Signals.Add(Signal);
		FCapturedFrame Frame;
		for (uint32_t I = 0; I < Frames; ++I)
		{
			View.bCut = I == 0;
			View.DeltaSeconds = 1.0f / 60.0f;
			const FRTStatus Status = GetEngine().RenderFrame(View, 0.0, Capture, &Frame);
			EXPECT_TRUE(Status) << Status.Message;
		}
		return Frame.Get(Signal);
	}
	static glm::dvec3 GetSum(const FImage& Image)
	{
		glm::dvec3 Sum(0);
		for (size_t I = 0; I + 2 < Image.Pixels.size(); I += Image.Channels)
		{
			Sum += glm::dvec3(Image.Pixels[I], Image.Pixels[I + 1], Image.Pixels[I + 2]);
		}
		return Sum;
	}
	/// Share of the lit pixels that are of the program's colour.
	static double GetPaintedShare(const FImage& Image)
	{
		double Lit = 0.0, Painted = 0.0;
		for (size_t I = 0; I + 2 < Image.Pixels.size(); I += Image.Channels)
		{
			Lit += Image.Pixels[I] > 0.02f ? 1.0 : 0.0;
			Painted += Image.Pixels[I] > 0.02f && Image.Pixels[I + 2] < 0.05f * Image.Pixels[I] ? 1.0 : 0.0;
		}
		return Painted / std::max(Lit, 1.0);
	}
	FView View;
};

TEST_F(FHitProgramsTest, LightIsOfStandardParametersUnlessAskedOtherwise)
{
	glm::dvec3 Sums[2];
	for (int Own = 0; Own <= 1; ++Own)
	{
		SetVariable("r.RT.GI.Materials", std::to_string(Own));
		Sums[Own] = GetSum(RenderLast(ESignal::DiffuseGI));
		ASSERT_GT(Sums[Own].x, 1.0);
		PrintFigure(fmt::format("programs {}: blue over red {:.4f}", Own ? "run" : "do not run", Sums[Own].z / Sums[Own].x));
	}
	EXPECT_NEAR(Sums[0].z / Sums[0].x, 1.0, 0.01) << "the wall counts as grey";
	EXPECT_LT(Sums[1].z / Sums[1].x, 0.35) << "its program paints it red; the rest is light of the floor";
}

TEST_F(FHitProgramsTest, MirrorsShowPrograms)
{
	double Shares[2];
	for (int Own = 0; Own <= 1; ++Own)
	{
		SetVariable("r.RT.GI.Materials", std::to_string(Own));
		Shares[Own] = GetPaintedShare(RenderLast(ESignal::Reflections));
	}
	PrintFigure(fmt::format("share of red in the mirror: {:.4f}, {:.4f} with programs everywhere", Shares[0], Shares[1]));
	EXPECT_GT(Shares[0], 0.1);
	EXPECT_NEAR(Shares[0], Shares[1], 0.05);
}

TEST_F(FHitProgramsTest, TheReferenceRunsPrograms)
{
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.Samples = 64;
	Settings.Signal = ESignal::DiffuseGI;
	const glm::dvec3 Sum = GetSum(TraceReference(Settings));
	EXPECT_LT(Sum.z / Sum.x, 0.35);
}

} // namespace
} // namespace Lantern
