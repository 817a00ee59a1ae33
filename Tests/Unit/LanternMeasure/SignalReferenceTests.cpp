// The cache of references: what hits, what misses, and what happens where it is damaged.
#include "LanternMeasure/SignalReference.h"

#include <filesystem>
#include <fstream>
#include <set>

#include <unistd.h>

#include "LanternHost/ReferenceRenderer.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

class FSignalReferenceTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		std::string Pattern = (fs::temp_directory_path() / "lantern-test-XXXXXX").string();
		ASSERT_NE(mkdtemp(Pattern.data()), nullptr);
		Folder = Pattern;
	}
	void TearDown() override
	{
		FRendererTest::TearDown();
		fs::remove_all(Folder);
	}

	FSignalReferenceDesc MakeDesc() const
	{
		FSignalReferenceDesc Desc;
		Desc.View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 16, 8);
		Desc.Signal = ESignal::Frame;
		Desc.Samples = 4;
		Desc.Bounces = 2;
		Desc.CacheFolder = (Folder / "cache" / "references").string();
		return Desc;
	}
	/// Whether it came from the cache.
	bool Get(const FSignalReferenceDesc& Desc)
	{
		const FRTStatus Status = GetSignalReference(*Engine, Desc, Reference);
		EXPECT_TRUE(Status) << Status.Message;
		return Reference.bFromCache;
	}

	fs::path Folder;
	FSignalReference Reference;
};

TEST_F(FSignalReferenceTest, TheSecondTimeItIsRead)
{
	ASSERT_TRUE(Load({.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bSky = true}));
	int Calls = 0;
	double Last = 0.0;
	FSignalReferenceDesc Desc = MakeDesc();
	Desc.Progress = [&](double Done, double Left) {
		++Calls;
		EXPECT_GE(Done, Last);
		EXPECT_LE(Done, 1.0);
		EXPECT_GE(Left, 0.0);
		Last = Done;
	};
	EXPECT_FALSE(Get(Desc));
	EXPECT_GT(Calls, 1);
	EXPECT_EQ(Last, 1.0);
	EXPECT_EQ(Reference.A.Width, 16u);
	EXPECT_EQ(Reference.Mean.Pixels.size(), Reference.B.Pixels.size());
	EXPECT_TRUE(fs::exists(GetSignalReferenceFile(*Engine, Desc)));
	Mock().ClearCalls();
	Calls = 0;
	EXPECT_TRUE(Get(Desc));
	EXPECT_EQ(Calls, 0);
	EXPECT_EQ(Mock().FindCalls(ERTMockCall::TraceRays).size(), 0u);
	Render(0.25); // frames between change nothing of it
	EXPECT_TRUE(Get(Desc));
	Open(); // neither does another process, or what is loaded before
	ASSERT_TRUE(Load({.bTexture = true, .bSun = false}));
	ASSERT_TRUE(Load({.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bSky = true}));
	EXPECT_TRUE(Get(Desc));
}

TEST_F(FSignalReferenceTest, WithoutAFolderNothingIsKept)
{
	ASSERT_TRUE(Load({}));
	FSignalReferenceDesc Desc = MakeDesc();
	Desc.CacheFolder.clear();
	EXPECT_FALSE(Get(Desc));
	EXPECT_FALSE(Get(Desc));
	EXPECT_TRUE(fs::is_empty(Folder));
}

TEST_F(FSignalReferenceTest, EveryPartOfTheDescriptionCounts)
{
	ASSERT_TRUE(Load({.bSky = true}));
	EXPECT_FALSE(Get(MakeDesc()));
	using FChange = void (*)(FSignalReferenceDesc&);
	const FChange Changes[] = {
	    [](auto& D) {
		D.View.Position.x += 1e-9;
	    },
	    [](auto& D) {
		D.View.Forward.x += 0.1f;
	},
	              [](auto& D) { D.View.Up.x += 0.1f; }, [](auto& D) { D.View.FovY = 0.9f; },
	              [](auto& D) { D.View.Width = 8, D.View.Height = 16; }, [](auto& D) { D.Time = 0.5; },
	              [](auto& D) { D.Signal = ESignal::AmbientOcclusion; }, [](auto& D) { D.Signal = ESignal::SunShadow; },
	              [](auto& D) { D.Samples = 6; }, [](auto& D) { D.Bounces = 3; }, [](auto& D) { D.Seed = 1; },
	              [](auto& D) { D.bPixelCenters = false; }, [](auto& D) { D.StateKey = "lid off"; },
	              };
	for (size_t I = 0; I < std::size(Changes); ++I)
	{
		FSignalReferenceDesc Desc = MakeDesc();
		Changes[I](Desc);
		EXPECT_FALSE(Get(Desc)) << "change " << I;
		EXPECT_TRUE(Get(Desc)) << "change " << I;
	}
	const FChange Neutral[] = {
	    [](auto& D) { D.View.FrameIndex = 7; }, [](auto& D) { D.View.Seed = 7; }, [](auto& D) { D.View.Exposure = 2.0f; },
	    [](auto& D) { D.View.DeltaSeconds = 0.1f; }, [](auto& D) { D.View.bCut = true; },
	    [](auto& D) { D.Samples = 3; }, // two for each half all the same
	};
	for (size_t I = 0; I < std::size(Neutral); ++I)
	{
		FSignalReferenceDesc Desc = MakeDesc();
		Neutral[I](Desc);
		EXPECT_TRUE(Get(Desc)) << "neutral change " << I;
	}
}

TEST_F(FSignalReferenceTest, EveryPartOfTheStateCounts)
{
	const FContent Content{.bMasked = true, .bLights = true, .bSky = true};
	std::set<std::string> Files;
	const auto ExpectNew = [&](const char* What) { EXPECT_TRUE(Files.insert(GetSignalReferenceFile(*Engine, MakeDesc())).second) << What; };
	ASSERT_TRUE(Load(Content));
	ExpectNew("first");
	FHostScene& Host = Engine->GetScene();
	FRTScene& Scene = Host.GetScene();
	FSunLight Sun = Scene.GetSun();
	Sun.Direction = {0.1, -1, 0};
	Host.SetSun(Sun);
	ExpectNew("sun's direction");
	Sun.AngularDiameter = 0.2f;
	Host.SetSun(Sun);
	ExpectNew("sun's size");
	Scene.SetSky(glm::vec3(2));
	ExpectNew("sky");
	Host.SetSceneLights(false);
	ExpectNew("lights");
	Host.SetTransform(0, glm::dmat4(2.0));
	ExpectNew("an object");
	FMaterialData Material = Scene.GetMaterials()[0];
	Material.Emissive = glm::vec3(1);
	Scene.SetMaterial(0, Material);
	ExpectNew("a material");
	FRTObjectInfo Extra = Scene.GetObject(Host.GetDraws()[0].Object);
	Extra.Mask = MaskVisible;
	const FRTObjectId Id = Scene.AddObject(Extra);
	ExpectNew("another object");
	Scene.RemoveObject(Id);
	Extra.Mask = MaskCasters;
	Scene.AddObject(Extra);
	ExpectNew("its mask");
	Set("r.RT.AlphaTest", "0");
	ExpectNew("alpha tests");
	Set("r.RT.Material.Override", "2");
	ExpectNew("override");
	Set("r.RT.Shadow.Samples", "4");
	EXPECT_TRUE(Files.contains(GetSignalReferenceFile(*Engine, MakeDesc()))) << "what methods do is none of it";
	ASSERT_TRUE(Load({.bMasked = true, .bLights = true, .bTexture = true, .bSky = true}));
	ExpectNew("another scene");
}

TEST_F(FSignalReferenceTest, VariablesOfASignalCountForItAlone)
{
	ASSERT_TRUE(Load({.bSky = true}));
	const auto GetFile = [&](ESignal Signal) {
		FSignalReferenceDesc Desc = MakeDesc();
		Desc.Signal = Signal;
		return GetSignalReferenceFile(*Engine, Desc);
	};
	Set("r.RT.AO.Radius", "2");
	const std::string Frame = GetFile(ESignal::Frame), Occlusion = GetFile(ESignal::AmbientOcclusion);
	Set("r.RT.AO.Radius", "3");
	EXPECT_EQ(GetFile(ESignal::Frame), Frame);
	EXPECT_NE(GetFile(ESignal::AmbientOcclusion), Occlusion);
	Set("r.RT.AO.Radius", "2");
	EXPECT_EQ(GetFile(ESignal::AmbientOcclusion), Occlusion);
}

// Shaders in a folder of their own, one of which is edited.
TEST_F(FSignalReferenceTest, AnEditedShaderIsAnotherReference)
{
	const fs::path Shaders = Folder / "Shaders";
	fs::copy(GetShaderFolder(), Shaders, fs::copy_options::recursive);
	Open({}, {Shaders.string()});
	ASSERT_TRUE(Load({.bSky = true}));
	EXPECT_FALSE(Get(MakeDesc()));
	const auto Edit = [&](const char* File) {
		std::ofstream(Shaders / File, std::ios::app) << "\n// edited\n";
		Open({}, {Shaders.string()});
		ASSERT_TRUE(Load({.bSky = true}));
	};
	Edit("ToneMap/ToneMap.comp");
	EXPECT_TRUE(Get(MakeDesc())) << "no part of the path tracer";
	for (const char* const File :
	    {"Reference/PathTrace.glsl", "Library/Sampling.glsl", "Rays/Material.rchit", "Rays/Shadow.rmiss", "Materials/Standard.glsl"})
	{
		Edit(File);
		EXPECT_FALSE(Get(MakeDesc())) << File;
		EXPECT_TRUE(Get(MakeDesc())) << File;
	}
}

TEST_F(FSignalReferenceTest, DamagedFilesAreTracedAnew)
{
	ASSERT_TRUE(Load({}));
	EXPECT_FALSE(Get(MakeDesc()));
	const std::string File = GetSignalReferenceFile(*Engine, MakeDesc());
	fs::resize_file(File, fs::file_size(File) - 3);
	EXPECT_FALSE(Get(MakeDesc()));
	EXPECT_TRUE(Get(MakeDesc())) << "it was written again";
	EXPECT_EQ(std::distance(fs::directory_iterator(fs::path(File).parent_path()), fs::directory_iterator()), 1);
}

TEST_F(FSignalReferenceTest, ACacheThatCannotBeWrittenIsDoneWithout)
{
	ASSERT_TRUE(Load({}));
	std::ofstream(Folder / "file") << "in the way";
	FSignalReferenceDesc Desc = MakeDesc();
	Desc.CacheFolder = (Folder / "file" / "references").string();
	EXPECT_FALSE(Get(Desc));
	EXPECT_FALSE(Get(Desc));
	EXPECT_EQ(Reference.A.Width, 16u);
}

TEST_F(FSignalReferenceTest, WithoutPipelinesItIsAnError)
{
	FRTMockDesc Mock;
	Mock.Rung = ERTRung::RayQuery;
	Open(Mock);
	ASSERT_TRUE(Load({}));
	EXPECT_FALSE(GetSignalReference(*Engine, MakeDesc(), Reference));
}

} // namespace
} // namespace Lantern
