// Frames while the scene and the settings change under them.
#include <cmath>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/SceneLoader.h"
#include "LanternImage/ImageStatistics.h"
#include "LanternScene/Memory/Upload.h"
#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{

class FSceneChangeTest : public FRenderTest
{
protected:
	/// A roof of its own over the floor: geometry and buffers, so that removing it frees memory that frames may still
	/// read.
	FRTObjectId AddRoof(float Height)
	{
		const glm::vec3 Positions[] = {{-1, Height, 1}, {1, Height, 1}, {1, Height, -1}, {-1, Height, -1}};
		const uint32_t Indices[] = {0, 1, 2, 0, 2, 3};
		const FVertexAttributes Attributes[4] = {};
		FUploader Uploader(GetDevice());
		FRTGeometryInfo Info;
		Info.Name = "roof";
		const ERTBufferUsage Usage = ERTBufferUsage::Storage | ERTBufferUsage::GeometryInput;
		EXPECT_OK(Uploader.CreateBuffer("roof", Usage, Positions, sizeof(Positions), Info.Positions));
		EXPECT_OK(Uploader.CreateBuffer("roof", Usage, Attributes, sizeof(Attributes), Info.Attributes));
		EXPECT_OK(Uploader.CreateBuffer("roof", Usage | ERTBufferUsage::Index, Indices, sizeof(Indices), Info.Indices));
		EXPECT_OK(Uploader.Flush());
		Info.VertexCount = 4;
		Info.Sections.push_back({0, 6, true});
		FRTScene& Scene = GetScene().GetScene();
		FRTObjectInfo Object;
		EXPECT_OK(Scene.CreateGeometry(std::move(Info), Object.Geometry));
		Object.Materials = {0};
		return Scene.AddObject(std::move(Object));
	}
	bool LoadFloor()
	{
		FTestScene Floor("floor");
		Floor.AddNode(Floor.AddMesh({FTestScene::MakeFloor(Floor.AddLambert(glm::vec3(0.5f)), 4.0f)}));
		const bool bLoaded = Load(std::move(Floor.Scene));
		SetSun(0.5, 4.0f, {0, -1, 0});
		return bLoaded;
	}
	static FView MakeFloorView() { return LookAt({0, 0.9, 0}, {0, 0, 0}, 1.2f, 32, 32); }
};

// Objects come and go while two frames are in flight; nothing that the GPU reads may be freed (the validation layers
// and the driver would notice), and all of it must be freed in the end.
TEST_F(FSceneChangeTest, ObjectsRemovedWhileFramesAreInFlight)
{
	ASSERT_TRUE(LoadFloor());
	const FView View = MakeFloorView();
	for (const char* Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0);
		EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
		GetDevice().CollectGarbage();
		const uint64_t Before = GetDevice().GetMemoryStats().Geometry;
		for (int Frame = 0; Frame < 24; ++Frame)
		{
			const FRTObjectId Roof = AddRoof(1.0f + 0.1f * float(Frame));
			ASSERT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr));
			if (Frame % 3 == 0) { ASSERT_OK(GetEngine().RenderFrame(View, 0.0, {}, nullptr)); }
			GetScene().GetScene().RemoveObject(Roof);
			// And one that no frame ever saw.
			GetScene().GetScene().RemoveObject(AddRoof(2.0f));
		}
		EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0) << "all roofs are gone";
		const FRTObjectId Last = AddRoof(1.0f);
		EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 0.0) << "the newest is there at once";
		GetScene().GetScene().RemoveObject(Last);
		for (int Frame = 0; Frame < 4; ++Frame) { EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 1.0); }
		GetDevice().CollectGarbage();
		EXPECT_EQ(GetDevice().GetMemoryStats().Geometry, Before) << "path " << Path;
	}
}

// Stability case 24: the same scene at the origin and far from it, in doubles. Pictures equal to 1e-3 of their mean, and
// no acne: hardly a pixel differs by more than its noise.
TEST_F(FSceneChangeTest, FarFromTheOrigin)
{
	FImage Raster[2], Reference[2];
	const glm::dvec3 Offsets[2] = {{0, 0, 0}, {16000.0, 500.0, 16000.0}};
	for (int Case = 0; Case < 2; ++Case)
	{
		FLoadResult Result = LoadScene("courtyard");
		ASSERT_TRUE(Result.Scene.has_value()) << Result.Error;
		for (FHostNode& Node : Result.Scene->Nodes)
		{
			if (Node.Parent >= 0) { continue; }
			if (Node.Matrix) { (*Node.Matrix)[3] += glm::dvec4(Offsets[Case], 0); }
			else { Node.Translation += Offsets[Case]; }
		}
		ASSERT_TRUE(Load(std::move(*Result.Scene)));
		SetSun(0.0);
		SetVariable("r.RT.AO", "0"); // its rays meet other edges with each rounding: FAmbientOcclusionTest has a test of its own
		GetEngine().SetFrameIndex(0);
		const FView View = MakeView(160, 90);
		Raster[Case] = RenderLightingFine(View, 2);
		Reference[Case] = TraceReference(View, 4, 2);
	}
	const auto Compare = [](const char* What, const FImage& Near, const FImage& Far) {
		const double Mean = MeanGreen(Near), Ratio = MeanGreen(Far) / Mean;
		const double Fraction = FractionDiffering(Near, Far, 0.02 * Mean);
		PrintFigure(fmt::format("{} at 22 km: mean ratio {:.6f}, {:.4f} % of the pixels differ", What, Ratio, 100 * Fraction));
		EXPECT_NEAR(Ratio, 1.0, 1e-3) << What;
		return Fraction;
	};
	EXPECT_LT(Compare("raster", Raster[0], Raster[1]), 0.01);
	// A path that takes another turn at an edge is another sample: only the mean is held to the figure.
	Compare("reference", Reference[0], Reference[1]);
}

// A camera that flies crosses the steps in which the scene's origin follows it.
TEST_F(FSceneChangeTest, OriginFollowsTheCamera)
{
	ASSERT_TRUE(LoadFloor());
	AddRoof(1.0f);
	FView View = MakeFloorView();
	EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 0.0);
	FView Away = View;
	for (const double X : {600.0, 5000.0, -20000.0})
	{
		Away.Position.x = X;
		EXPECT_EQ(MeanGreen(RenderSunShadow(Away)), 1.0);
		EXPECT_EQ(MeanGreen(RenderSunShadow(View)), 0.0) << "back from " << X;
	}
}

enum class EPicture : uint8_t
{
	Equal,  ///< the variable says how a frame is made
	Other,  ///< the variable says what is to be seen
	Either, ///< the value or the scene decides
};

EPicture ExpectPicture(const std::string& Variable)
{
	const auto StartsWith = [&](const char* Prefix) { return Variable.rfind(Prefix, 0) == 0; };
	for (const char* const Prefix : {"r.RT.FrameGraph.", "r.RT.SBT.", "r.RT.Scene.", "r.RT.Upload.", "r.RT.Pipeline.", "r.RT.Shader",
	         "r.RT.Trace", "r.RT.Reorder", "r.RT.Opacity.", "r.RT.Build.TrianglesPerFrame", "r.RT.Build.Compaction"})
	{
		if (StartsWith(Prefix)) { return EPicture::Equal; }
	}
	for (const char* const Name : {"r.RT.Enable", "r.RT.Shadow", "r.RT.AO", "r.RT.Shadow.Soft", "r.RT.AO.Denoise"})
	{
		if (Variable == Name) { return EPicture::Other; }
	}
	return EPicture::Either;
}

using FSceneChangeSlowTest = FSceneChangeTest; // the driver compiles the courtyard's pipelines again for most variables

// Every switch flipped between frames: the next frame is drawn without a message and shows what it should, and back at the default
// the picture is what it was.
TEST_F(FSceneChangeSlowTest, TogglesBetweenFrames)
{
	ASSERT_TRUE(Load("courtyard"));
	FView View = MakeView(64, 36);
	View.bCut = true; // a frame that accumulates shows those before it, too
	const auto Draw = [&] {
		GetEngine().SetFrameIndex(0);
		return RenderLighting(View);
	};
	const auto Reset = [] { // without what the fixture sets
		FConsoleVariables::Get().ResetAll();
		SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "60000"); // most of the time of small pictures
	};
	Reset();
	const FImage Before = Draw();
	int Flipped = 0;
	for (const FRTConsoleVariable* Variable : FConsoleVariables::Get().GetAll())
	{
		std::vector<std::string> Values;
		if (const bool* Default = std::get_if<bool>(&Variable->GetDefault())) { Values = {*Default ? "0" : "1"}; }
		else if (std::get_if<int32_t>(&Variable->GetDefault()))
		{
			const FRTCVarRange Range = Variable->GetRange();
			Values = {
			    std::to_string(int(Range.Min)), std::to_string(int(std::min(Range.Max, Range.Min + 2))), std::to_string(int(Range.Max))};
		}
		for (const std::string& Value : Values)
		{
			SetVariable(Variable->GetName().c_str(), Value);
			const FImage Changed = Draw();
			EXPECT_EQ(CountNonFinitePixels(Changed), 0u) << Variable->GetName() << "=" << Value;
			const EPicture Expected = ExpectPicture(Variable->GetName());
			const double Difference = MaxDifference(Changed, Before);
			if (Expected == EPicture::Equal) { EXPECT_EQ(Difference, 0.0) << Variable->GetName() << "=" << Value; }
			if (Expected == EPicture::Other) { EXPECT_GT(Difference, 0.01) << Variable->GetName() << "=" << Value; }
			++Flipped;
		}
		if (Values.empty()) { continue; }
		Reset();
		const FImage After = Draw();
		EXPECT_EQ(MaxDifference(After, Before), 0.0)
		    << "after " << Variable->GetName() << ", " << FractionDiffering(After, Before, 0.0) << " of the pixels";
	}
	EXPECT_GE(Flipped, 15);
}

// Without shadows the sun lights everything; without the plugin there is no pass of it.
TEST_F(FSceneChangeTest, ShadowsAndPluginOff)
{
	ASSERT_TRUE(Load("courtyard"));
	const FView View = MakeView(96, 54);
	SetVariable("r.RT.Transmission", "0"); // the fountain's water has rays of its own
	const double Shadowed = MeanGreen(RenderLighting(View));
	for (const char* Name : {"r.RT.Shadow", "r.RT.Enable"})
	{
		SetVariable(Name, "0");
		SetVariable("r.RT.Lights", Name == std::string("r.RT.Enable") ? "1" : "0"); // lamps have rays of their own
		SetVariable("r.RT.AO", Name == std::string("r.RT.Enable") ? "1" : "0");     // has rays of its own
		EXPECT_GT(MeanGreen(RenderLighting(View)), 1.1 * Shadowed) << Name;
		for (const FPassTiming& Pass : GetEngine().GetRenderer().GetGraphResources().GetTimings())
		{
			EXPECT_NE(Pass.Name, "SunShadow") << Name;
			EXPECT_EQ(Pass.Rays, 0u) << Name;
		}
		SetVariable(Name, "1");
	}
	SetVariable("r.RT.Lights", "1");
	SetVariable("r.RT.Shadow.Soft", "0");
	SetVariable("r.RT.Material.Override", "1");
	EXPECT_GT(MeanGreen(RenderLighting(View)), 0.0);
}

// Lights, sun and sky that change take effect in the next frame.
TEST_F(FSceneChangeTest, LightChangesAtOnce)
{
	ASSERT_TRUE(LoadFloor());
	const FView View = MakeFloorView();
	const double Bright = MeanGreen(RenderLighting(View));
	SetSun(0.5, 2.0f, {0, -1, 0});
	EXPECT_NEAR(MeanGreen(RenderLighting(View)), 0.5 * Bright, 1e-4 * Bright);
	SetSun(0.5, 0.0f, {0, -1, 0});
	EXPECT_EQ(MeanGreen(RenderLighting(View)), 0.0);
	SetSky({1, 1, 1});
	EXPECT_NEAR(MeanGreen(RenderLighting(View)), 0.5, 0.01);
	SetSky({0, 0, 0});
	FSceneLight Light{};
	Light.Position = {0, 2, 0};
	Light.Color = glm::vec3(10);
	const FLightId Id = GetScene().GetScene().AddLight(Light);
	EXPECT_GT(MeanGreen(RenderLighting(View)), 0.1);
	GetScene().GetScene().RemoveLight(Id);
	EXPECT_EQ(MeanGreen(RenderLighting(View)), 0.0);
}

} // namespace
} // namespace Lantern
