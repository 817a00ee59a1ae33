// Every console variable, set at random every frame, while the world streams: no frame fails, and afterwards the
// defaults give the frame that they gave before.
#include <random>

#include "StreamingWorld.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

class FToggleStressTest : public FRendererTest
{
protected:
	/// A value that the variable allows.
	static std::string Choose(const FRTConsoleVariable& Variable, std::mt19937& Random)
	{
		const FRTCVarValue Value = Variable.GetDefault();
		const FRTCVarRange Range = Variable.GetRange();
		const double Share = std::uniform_real_distribution<double>(0.0, 1.0)(Random);
		if (std::holds_alternative<bool>(Value)) { return Share < 0.5 ? "0" : "1"; }
		if (std::holds_alternative<std::string>(Value)) { return FConsoleVariables::ToString(Value); }
		// A wide range is walked around the default as well as at its ends.
		const double Default = std::holds_alternative<float>(Value) ? std::get<float>(Value) : std::get<int32_t>(Value);
		const double Low = std::max(Range.Min, Default - 4.0 - std::abs(Default)),
		             High = std::min(Range.Max, Default + 4.0 + std::abs(Default));
		const double Chosen = Share < 0.1   ? std::max(Range.Min, -1e6)
		                      : Share < 0.2 ? std::min(Range.Max, 1e6)
		                                    : Low + (High - Low) * (Share - 0.2) / 0.8;
		return std::holds_alternative<float>(Value) ? std::to_string(Chosen) : std::to_string(static_cast<int64_t>(std::lround(Chosen)));
	}
	static bool IsLeftAlone(const std::string& Name)
	{
		// What writes files, and what starts threads by the dozen for every value.
		return Name.rfind("r.RT.Trace", 0) == 0 || Name == "r.RT.Pipeline.Threads";
	}
};

TEST_F(FToggleStressTest, EveryVariableEveryFrame)
{
	ASSERT_NO_FATAL_FAILURE(LoadAndRender({.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bSky = true}));
	ASSERT_NO_FATAL_FAILURE(Render(1.0));
	const std::vector<std::string> Passes = GetPasses();
	FStreamingWorld World(*Device, Engine->GetScene().GetScene(), {.ObjectsPerTile = 4});
	std::mt19937 Random(7);
	for (int Frame = 0; Frame < 400; ++Frame)
	{
		SCOPED_TRACE("frame " + std::to_string(Frame));
		// Where frames wait for nothing, pipelines that change every frame are never there; so half of them wait.
		Engine->bRealTime = Frame % 8 < 4;
		std::string Settings;
		for (const FRTConsoleVariable* const Variable : FConsoleVariables::Get().GetAll())
		{
			if (IsLeftAlone(Variable->GetName())) { continue; }
			const std::string Value = Choose(*Variable, Random);
			Settings += Variable->GetName() + "=" + Value + " ";
			Set(Variable->GetName().c_str(), Value.c_str());
		}
		const glm::dvec3 Camera = FStreamingWorld::FlightAt(Frame / 10.0);
		ASSERT_TRUE(World.MoveTo(Camera));
		Mock().ClearCalls();
		const FRTStatus Status = RenderFrame(Frame / 30.0, Camera);
		ASSERT_TRUE(Status) << Status.Message << "\n" << Settings;
		ASSERT_EQ(Messages, std::vector<std::string>()) << Settings;
		ASSERT_EQ(Mock().GetErrors(), std::vector<std::string>()) << Settings;
	}
	FConsoleVariables::Get().ResetAll();
	Engine->bRealTime = false;
	for (int Frame = 0; Frame < 8; ++Frame) { ASSERT_NO_FATAL_FAILURE(Render(20.0)); }
	ASSERT_NO_FATAL_FAILURE(Render(21.0));
	EXPECT_EQ(GetPasses(), Passes);
}

} // namespace
} // namespace Lantern
