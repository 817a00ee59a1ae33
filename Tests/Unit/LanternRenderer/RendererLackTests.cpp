// Cost follows content: scenes that have all there is but one thing, and what is then not there: passes, buffers, textures
// (histories among them), pipelines and shaders. What is named here must be there in the full scene, so that no name rots.
#include <functional>
#include <set>

#include "LanternCore/FrameGraph/History.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

using FNames = std::set<std::string>; ///< "pass SunShadow", "texture SunShadowHistory", …

struct FStage
{
	FContent Content = {
	    .bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bEmissive = true, .bSun = true, .bSky = true};
	bool bMoves = true; ///< an object travels; what is skinned moves in any case
	bool bAway = false; ///< the camera looks where nothing is
	std::vector<std::pair<const char*, const char*>> Settings;
	FRTMockDesc Device;
};

bool HasPart(const FNames& Names, const std::string& Part)
{
	return std::any_of(Names.begin(), Names.end(), [&](const std::string& Name) { return Name.find(Part) != std::string::npos; });
}

class FRendererLackTest : public FRendererTest
{
protected:
	static constexpr int FrameCount = 4;

	/// Names of all that some frames on a new device make and run; Settings of the stage come after these.
	FNames Make(const FStage& Stage, const std::vector<std::pair<const char*, const char*>>& Settings = {})
	{
		FConsoleVariables::Get().ResetAll();
		Open(Stage.Device);
		Set("r.RT.Reflections", "2");
		for (const auto& [Name, Value] : Settings) { Set(Name, Value); }
		for (const auto& [Name, Value] : Stage.Settings) { Set(Name, Value); }
		FSceneDescription Scene = MakeDescription(Stage.Content);
		if (Stage.bMoves && Stage.Content.bObjects)
		{
			FHostChannel Travel{.Node = 0, .Times = {0.0f, 10.0f}, .Values = {glm::vec4(0), glm::vec4(3, 0, 0, 0)}};
			Scene.Animations.push_back({"Travel", {Travel}, 10.0f});
		}
		EXPECT_TRUE(Engine->Load(std::move(Scene)));
		ApplySky(Stage.Content);
		for (int Index = 0; Index < FrameCount; ++Index)
		{
			FFrameCapture Capture;
			Capture.bDisplay = true;
			const FView View = LookAt({0, 0, 5.0 + Index}, {0, 0, Stage.bAway ? 50.0 : 0.0}, 1.0f, 40, 24);
			const FRTStatus Status = Engine->RenderFrame(View, Index * 0.1, Capture, &Captured);
			EXPECT_TRUE(Status) << Status.Message;
		}
		return CollectNames();
	}
	FNames CollectNames()
	{
		FNames Names;
		for (const std::string& Name : Mock().GetCreatedBuffers()) { Names.insert("buffer " + Name); }
		for (const std::string& Name : Mock().GetCreatedTextures()) { Names.insert("texture " + Name); }
		for (const std::string& Name : Mock().GetCreatedPipelines()) { Names.insert("pipeline " + Name); }
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BeginMarker)) { Names.insert("pass " + Call.Name); }
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			const bool bIndirect = Call.Kind == ERTMockCall::DispatchIndirect || Call.Kind == ERTMockCall::TraceRaysIndirect;
			if (bIndirect) { Names.insert("indirect " + Call.Name); }
			if (Call.Kind == ERTMockCall::Dispatch) { Names.insert("dispatch " + Call.Name); }
		}
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::CreateScene)) { Names.insert("scene structure" + Call.Name); }
		return Names;
	}
	/// Without what shaders are told of the scene: a scene that lacks something has other variants of the same.
	static FNames StripVariants(const FNames& Names)
	{
		FNames Stripped;
		for (const std::string& Name : Names) { Stripped.insert(Name.substr(0, Name.find(' ', Name.find(' ') + 1))); }
		return Stripped;
	}
	/// All of Parts are in names of the full scene, and none in those of the one that lacks something.
	void ExpectAbsent(const char* What, const FStage& Lacking, const std::vector<const char*>& Parts)
	{
		for (const char* const Path : {"1", "2"})
		{
			const std::vector<std::pair<const char*, const char*>> Paths = {{"r.RT.Shadow.Path", Path}, {"r.RT.AO.Path", Path}};
			const FNames Full = Make({}, Paths), Left = Make(Lacking, Paths);
			for (const char* const Part : Parts)
			{
				EXPECT_TRUE(HasPart(Full, Part)) << What << ", path " << Path << ": nothing is called " << Part;
				EXPECT_FALSE(HasPart(Left, Part)) << What << ", path " << Path << ": " << Part << " is there";
			}
			const FNames FullStripped = StripVariants(Full);
			for (const std::string& Name : StripVariants(Left))
			{
				EXPECT_TRUE(FullStripped.count(Name)) << What << ": " << Name << " instead";
			}
		}
	}
};

TEST_F(FRendererLackTest, NoAlphaTests)
{
	FStage Stage;
	Stage.Content.bMasked = false;
	ExpectAbsent("no alpha tests", Stage, {"asked", "Leaves"}); // GBufferMasked, … SHADOW masked
	EXPECT_TRUE(HasPart(Make({}, {{"r.RT.Shadow.Path", "2"}}), "HAS_MASKED"));
	EXPECT_FALSE(HasPart(Make(Stage, {{"r.RT.Shadow.Path", "2"}}), "HAS_MASKED"));
}

TEST_F(FRendererLackTest, NoSkinning)
{
	FStage Stage;
	Stage.Content.bSkinned = false;
	ExpectAbsent("no skinning", Stage, {"pass Skinning", "Skin.comp", "RefitQuality", "Body"});
}

TEST_F(FRendererLackTest, NoLocalLights)
{
	FStage Stage;
	Stage.Content.bLights = false;
	ExpectAbsent("no lamps", Stage, {"buffer Lights", "HAS_LIGHTS"});
	Stage.Content.bEmissive = false;
	ExpectAbsent("no local lights", Stage,
	    {"buffer Lights", "HAS_LIGHTS", "pass ShadowLights", "LocalLights/", "TileLights", "LocalDiffuse", "LocalSpecular"});
	EXPECT_TRUE(HasPart(Make({}, {{"r.RT.Shadow.Path", "2"}}), "LOCAL_RAYS"));
	EXPECT_FALSE(HasPart(Make(Stage, {{"r.RT.Shadow.Path", "2"}}), "LOCAL_RAYS"));
}

// Emissive triangles are listed for reflections as well.
TEST_F(FRendererLackTest, NoEmissiveTriangles)
{
	const std::vector<const char*> Parts = {
	    "EmitterClusters", "LOCAL_EMISSIVE", "pass ShadowEmitters", "LightGuide", "LightChoices", "LitPixels", "MANY_LIGHTS"};
	FStage Stage;
	Stage.Settings = {{"r.RT.Lights.Emissive", "0"}};
	ExpectAbsent("emissive triangles are no local lights", Stage, Parts);
	Stage.Settings.emplace_back("r.RT.Reflections", "0");
	std::vector<const char*> Lists = Parts;
	Lists.insert(Lists.end(), {"EmissiveTriangles", "EmissiveClusters", "EmissivePowers", "EmissiveRanges"});
	ExpectAbsent("nobody samples emissive triangles", Stage, Lists);
	FStage Dark;
	Dark.Content.bEmissive = false;
	ExpectAbsent("nothing emits", Dark, Lists);
}

TEST_F(FRendererLackTest, LocalLightsWithoutShadowsOrOff)
{
	for (const char* const Variable : {"r.RT.Lights", "r.RT.LocalLights"})
	{
		FStage Stage;
		Stage.Settings = {{Variable, "0"}};
		ExpectAbsent(Variable, Stage, {"pass ShadowLights", "LocalLights/", "TileLights", "LocalDiffuse", "LocalSpecular"});
	}
}

TEST_F(FRendererLackTest, NoLightThatAsksForShadowRays)
{
	FStage Stage;
	Stage.Content.bSun = Stage.Content.bLights = Stage.Content.bEmissive = false;
	ExpectAbsent("neither sun nor local lights", Stage,
	    {"indirect ", "ShadowQueue", "buffer RayRequests", "buffer RayQueueCounters", "buffer RayAnswers", "buffer SunWidths"});
}

TEST_F(FRendererLackTest, NoSun)
{
	FStage Stage;
	Stage.Content.bSun = false;
	ExpectAbsent("no sun", Stage,
	    {"pass SunShadow", "texture SunShadow", "SunShadowTemporal", "SunShadowFilter", "SunShadowHistory", "SunShadow/SunShadow",
	        "HAS_SUN", "pass ShadowTiles", "Tiles/Tiles.comp", "Tiles/QueueSun.comp", "buffer Tiles", "buffer SunWidths"});
	EXPECT_TRUE(HasPart(Make({}, {{"r.RT.Shadow.Path", "2"}}), "SUN_RAYS"));
	EXPECT_FALSE(HasPart(Make(Stage, {{"r.RT.Shadow.Path", "2"}}), "SUN_RAYS"));
}

TEST_F(FRendererLackTest, NoSky)
{
	FStage Stage;
	Stage.Content.bSky = false;
	ExpectAbsent("no sky", Stage,
	    {"pass AmbientOcclusion", "texture AmbientOcclusion", "AmbientOcclusionTemporal", "AmbientOcclusionHistory",
	        "AmbientOcclusion/AmbientOcclusion", "HAS_SKY"});
}

TEST_F(FRendererLackTest, NoEmissiveSurfaces)
{
	FStage Stage;
	Stage.Content.bEmissive = false;
	ExpectAbsent("no emissive surfaces", Stage, {"EmissiveTriangles", "Panel"});
}

TEST_F(FRendererLackTest, NoTextures)
{
	FStage Stage;
	Stage.Content.bTexture = false;
	ExpectAbsent("no textures", Stage, {"texture Picture"});
}

TEST_F(FRendererLackTest, NoObjects)
{
	FStage Stage;
	Stage.Content = {.bObjects = false, .bSky = true};
	ExpectAbsent(
	    "no objects", Stage, {"Reflections", "AmbientOcclusion", "Standard MATERIAL", "Standard SHADOW", "ObjectMotions", "buffer Lights"});
}

TEST_F(FRendererLackTest, NoLightAtAllNoRays)
{
	FStage Stage;
	Stage.Content.bSun = Stage.Content.bSky = Stage.Content.bLights = Stage.Content.bEmissive = false;
	ExpectAbsent("no light at all", Stage,
	    {"SunShadow", "AmbientOcclusion", "Reflections", "Structures", "ShaderTable", "RTPSO", "scene structure", "Denoise", "Surface",
	        "History", "GBufferMotion", "ObjectMotions"});
}

TEST_F(FRendererLackTest, NothingMoves)
{
	FStage Stage;
	Stage.bMoves = false;
	Stage.Content.bSkinned = false;
	ExpectAbsent("nothing moves", Stage, {"ObjectMotions", "pass Skinning"});
	Mock().ClearCalls();
	Render(5.0);
	Render(6.0);
	const FNames Again = CollectNames();
	for (const char* const Part : {"pass SceneUpdate", "pass Structures", "pass Skinning", "pass EmissiveTriangles"})
	{
		EXPECT_FALSE(HasPart(Again, Part)) << Part;
	}
}

/// What an engine's G-buffer shows need not be in the scene that rays see: passes over the screen cannot be left out because
/// no object of the scene is in view. They run, and end at once where there is only sky. What is left out is what goes by object.
TEST_F(FRendererLackTest, NothingInView)
{
	FStage Stage;
	Stage.bAway = true;
	Stage.Content.bSkinned = false; // the host has no bounds of what joints move, and draws it always
	Make(Stage);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::DrawIndexed), 0u);
	EXPECT_THAT(Mock().GetCreatedPipelines(), Contains("GBufferMasked")) << "it must be there when something comes into view";
	Make({});
	EXPECT_GT(Mock().CountCalls(ERTMockCall::DrawIndexed), 0u);
}

// The same of settings -------------------------------------------------------------------------------------------------

TEST_F(FRendererLackTest, NoReflectionsNoMaterialRays)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.Reflections", "0"}};
	ExpectAbsent("no reflections", Stage, {"Reflections", "MATERIAL", "Material.rmiss"});
}

TEST_F(FRendererLackTest, NoFilterNoHistoryAndNoMotion)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.Shadow.Denoise", "0"}, {"r.RT.AO.Denoise", "0"}, {"r.RT.Lights.Denoise", "0"}};
	Stage.Content.bEmissive = false; // tiles remember which of many lights are hidden
	ExpectAbsent("no filter", Stage,
	    {"Denoise", "Temporal", "Filter", "Surface", "History", "GBufferMotion", "ObjectMotions", "SunShadowPenumbra", "SunWidths"});
	const std::vector<std::pair<const char*, const char*>> Pipeline = {{"r.RT.Shadow.Path", "1"}};
	EXPECT_TRUE(HasPart(Make({}, Pipeline), "Shadow.rchit"));
	EXPECT_FALSE(HasPart(Make(Stage, Pipeline), "Shadow.rchit")) << "shadow rays run nothing where they hit";
	EXPECT_EQ(Engine->GetRenderer().GetHistoryBytes(), 0u);
	Engine->Signals.bMotion = true;
	Render(0.5);
	EXPECT_TRUE(HasPart(CollectNames(), "buffer ObjectMotions")) << "who asks has it without a filter";
}

TEST_F(FRendererLackTest, HardShadowsNeedNoFilter)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.Shadow.Soft", "0"}};
	ExpectAbsent("hard shadows", Stage, {"SunShadowTemporal", "SunShadowFilter", "SunShadowHistory", "SunShadowPenumbra", "SunWidths"});
}

TEST_F(FRendererLackTest, DiffuseGITakesThePlaceOfAmbientOcclusion)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.GI", "1"}};
	const FNames Without = Make({}), With = Make(Stage);
	EXPECT_FALSE(HasPart(Without, "DiffuseGI"));
	EXPECT_TRUE(HasPart(With, "pass DiffuseGI"));
	EXPECT_TRUE(HasPart(With, "texture DiffuseGI"));
	EXPECT_TRUE(HasPart(With, "DiffuseGI/DiffuseGI.rgen"));
	EXPECT_TRUE(HasPart(Without, "AmbientOcclusion"));
	EXPECT_FALSE(HasPart(With, "AmbientOcclusion"));
}

TEST_F(FRendererLackTest, RadianceCellsAreThereForRoutesThatEndInThem)
{
	FStage BruteForce, Cells;
	BruteForce.Settings = {{"r.RT.GI", "1"}};
	Cells.Settings = {{"r.RT.GI", "3"}};
	const FNames Without = Make(BruteForce), With = Make(Cells);
	EXPECT_FALSE(HasPart(Without, "RadianceCell"));
	for (const char* Part : {"Clear", "NewCells", "Votes", "Age", "Cut", "List", "UpdateAndDiffuseGIDeferred", "Commit"})
	{
		EXPECT_TRUE(HasPart(With, std::string("pass RadianceCells") + Part)) << Part;
	}
	EXPECT_TRUE(HasPart(With, "buffer RadianceCells"));
	FStage Dark = Cells;
	Dark.Content.bSun = Dark.Content.bSky = Dark.Content.bLights = Dark.Content.bEmissive = false;
	EXPECT_FALSE(HasPart(Make(Dark), "RadianceCell")) << "without light";
	FStage Empty = Cells;
	Empty.Content = {.bObjects = false, .bSky = true};
	EXPECT_FALSE(HasPart(Make(Empty), "RadianceCell")) << "without surfaces";
}

TEST_F(FRendererLackTest, GlassHasItsPassesAlone)
{
	FStage Glass, Off;
	Glass.Content.bGlass = Off.Content.bGlass = true;
	Off.Settings = {{"r.RT.Transmission", "0"}};
	const FNames Made = Make(Glass), Opaque = Make(Off), None = Make({});
	for (const char* Part : {"pass Transmission", "pass TransmissionComposite", "texture TransmissionLooks",
	         "Transmission/Transmission.rgen", "Transmission/Composite.comp"})
	{
		EXPECT_TRUE(HasPart(Made, Part)) << Part;
		EXPECT_FALSE(HasPart(Opaque, Part)) << "glass is opaque: " << Part;
		EXPECT_FALSE(HasPart(None, Part)) << "light shines through nothing: " << Part;
	}
}

TEST_F(FRendererLackTest, ASkyProgramHasItsPassesAlone)
{
	FStage Program, InPlace;
	Program.Settings = {{"r.Sky.Program", "1"}};
	InPlace.Settings = {{"r.Sky.Program", "1"}, {"r.RT.Sky.Bake", "0"}};
	const FNames Made = Make(Program), Run = Make(InPlace), None = Make({});
	for (const char* Part : {"pass SkyBake", "pass SkyFade", "texture SkyBaked", "texture SkyShown", "Sky/Bake.comp", "Sky/Fade.comp"})
	{
		EXPECT_TRUE(HasPart(Made, Part)) << Part;
		EXPECT_FALSE(HasPart(Run, Part)) << "shaders run the program: " << Part;
		EXPECT_FALSE(HasPart(None, Part)) << "the sky is uniform: " << Part;
	}
	EXPECT_TRUE(HasPart(Run, "SKY_IN_PLACE"));
	EXPECT_FALSE(HasPart(None, "SKY_IN_PLACE"));
}

TEST_F(FRendererLackTest, ReflectionsByPathsHaveTheirPassesAlone)
{
	FStage Off, BruteForce, Paths, Raw;
	Off.Settings = {{"r.RT.Reflections", "0"}};
	Paths.Settings = {{"r.RT.Reflections", "1"}};
	Raw.Settings = {{"r.RT.Reflections", "1"}, {"r.RT.Reflections.Denoise", "0"}};
	const FNames Made = Make(Paths), Unfiltered = Make(Raw), None = Make(Off), Brute = Make(BruteForce);
	for (const char* Part : {"pass ReflectionsList", "pass ReflectionsCombine", "Reflections/Paths", "pass ReflectionsThreads"})
	{
		EXPECT_TRUE(HasPart(Made, Part)) << Part;
		EXPECT_TRUE(HasPart(Unfiltered, Part)) << Part;
		EXPECT_FALSE(HasPart(None, Part)) << Part;
		EXPECT_FALSE(HasPart(Brute, Part)) << Part;
	}
	for (const char* Part : {"ReflectionSurface", "ReflectionAnchors", "pass ReflectionsSurface", "pass ReflectionsTemporal"})
	{
		EXPECT_TRUE(HasPart(Made, Part)) << Part;
		EXPECT_FALSE(HasPart(Unfiltered, Part)) << "without a filter: " << Part;
	}
	FStage Dark = Paths;
	Dark.Content.bSun = Dark.Content.bSky = Dark.Content.bLights = Dark.Content.bEmissive = false;
	EXPECT_FALSE(HasPart(Make(Dark), "Reflection")) << "without light";
	FStage Empty = Paths;
	Empty.Content = {.bObjects = false, .bSky = true};
	EXPECT_FALSE(HasPart(Make(Empty), "Reflection")) << "without surfaces";
	EXPECT_FALSE(HasPart(Made, "RadianceCell")) << "cells are global illumination's";
	FStage WithCells = Paths;
	WithCells.Settings.emplace_back("r.RT.GI", "3");
	EXPECT_TRUE(HasPart(Make(WithCells), "pass ReflectionsList"));
}

TEST_F(FRendererLackTest, PicturesOfRadianceCellsAreThereWhereSomebodyLooks)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.GI", "3"}};
	EXPECT_FALSE(HasPart(Make(Stage), "RadianceCellsView"));
	for (const char* const Picture : {"radiance_cells", "radiance_light"})
	{
		Stage.Settings = {{"r.RT.GI", "3"}, {"r.RT.Debug.View", Picture}};
		EXPECT_TRUE(HasPart(Make(Stage), "pass RadianceCellsView")) << Picture;
	}
	Stage.Settings = {{"r.RT.GI", "1"}, {"r.RT.Debug.View", "radiance_cells"}};
	EXPECT_FALSE(HasPart(Make(Stage), "RadianceCellsView")) << "without cells";
}

TEST_F(FRendererLackTest, ScreenProbesAreThereForTheirRouteAlone)
{
	FStage Pixels, Probes;
	Pixels.Settings = {{"r.RT.GI", "3"}, {"r.RT.GI.Rate", "2"}};
	Probes.Settings = {{"r.RT.GI", "2"}, {"r.RT.GI.Rate", "2"}};
	const FNames Without = Make(Pixels), With = Make(Probes);
	EXPECT_FALSE(HasPart(Without, "ScreenProbe"));
	for (const char* Part : {"Plan", "Resolve", "Project", "Gather"})
	{
		EXPECT_TRUE(HasPart(With, std::string("pass ScreenProbes") + Part)) << Part;
	}
	EXPECT_TRUE(HasPart(With, "buffer ScreenProbes"));
	EXPECT_FALSE(HasPart(With, "pass DiffuseGIFill")) << "all pixels have a value";
	FStage Dark = Probes;
	Dark.Content.bSun = Dark.Content.bSky = Dark.Content.bLights = Dark.Content.bEmissive = false;
	EXPECT_FALSE(HasPart(Make(Dark), "ScreenProbe")) << "without light";
	FStage Empty = Probes;
	Empty.Content = {.bObjects = false, .bSky = true};
	EXPECT_FALSE(HasPart(Make(Empty), "ScreenProbe")) << "without surfaces";
}

TEST_F(FRendererLackTest, OnlySharedPathsAreResolved)
{
	FStage Shared, Alone, Brute;
	Shared.Settings = {{"r.RT.GI", "3"}, {"r.RT.GI.Rate", "2"}};
	Alone.Settings = {{"r.RT.GI", "3"}, {"r.RT.GI.Rate", "2"}, {"r.RT.GI.Reuse", "0"}};
	Brute.Settings = {{"r.RT.GI", "1"}, {"r.RT.GI.Rate", "2"}};
	const FNames With = Make(Shared);
	EXPECT_TRUE(HasPart(With, "pass PathResolve"));
	EXPECT_FALSE(HasPart(With, "pass DiffuseGIFill")) << "all pixels have a value";
	for (const FStage& Stage : {Alone, Brute})
	{
		const FNames Names = Make(Stage);
		EXPECT_FALSE(HasPart(Names, "PathResolve"));
		EXPECT_TRUE(HasPart(Names, "pass DiffuseGIFill"));
	}
	FStage Dark = Shared;
	Dark.Content.bSun = Dark.Content.bSky = Dark.Content.bLights = Dark.Content.bEmissive = false;
	EXPECT_FALSE(HasPart(Make(Dark), "PathResolve")) << "without light";
}

TEST_F(FRendererLackTest, DevicesWithoutPipelinesHaveDiffuseGIByQueries)
{
	FStage Stage;
	Stage.Device.Rung = ERTRung::RayQuery;
	Stage.Settings = {{"r.RT.GI", "3"}, {"r.RT.GI.Rate", "2"}};
	const FNames Names = Make(Stage);
	for (const char* Part : {"pass DiffuseGI", "DiffuseGI/DiffuseGI.comp", "RadianceCells/Update.comp", "pass PathResolve"})
	{
		EXPECT_TRUE(HasPart(Names, Part)) << Part;
	}
	EXPECT_FALSE(HasPart(Names, ".rgen"));
}

TEST_F(FRendererLackTest, RayTracingOffLeavesTheRaster)
{
	FStage Stage;
	Stage.Settings = {{"r.RT.Enable", "0"}, {"r.RT.GI", "1"}};
	ExpectAbsent("no ray tracing", Stage,
	    {"SunShadow", "AmbientOcclusion", "Reflections", "Structures", "ShaderTable", "RTPSO", "scene structure", "Denoise", "Surface",
	        "History", "GBufferMotion", "ObjectMotions", "EmissiveTriangles"});
	Mock().ClearCalls();
	Render(0.3);
	EXPECT_THAT(GetPassesWithoutFilters(), Not(Contains("Structures")));
}

/// A signal that ends leaves no history behind for long.
TEST_F(FRendererLackTest, HistoriesOfASignalThatEndedAreFreed)
{
	Make({});
	FRenderer& Renderer = Engine->GetRenderer();
	const uint64_t Both = Renderer.GetHistoryBytes();
	Set("r.RT.AO", "0");
	for (uint32_t Index = 0; Index < FHistoryResources::KeepFrames + 1; ++Index) { Render(0.3); }
	EXPECT_LT(Renderer.GetHistoryBytes(), Both);
	Set("r.RT.Shadow", "0");
	Set("r.RT.Lights", "0");
	for (uint32_t Index = 0; Index < FHistoryResources::KeepFrames + 1; ++Index) { Render(0.3); }
	EXPECT_EQ(Renderer.GetHistoryBytes(), 0u);
}

} // namespace
} // namespace Lantern
