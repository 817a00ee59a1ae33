// What goes wrong outside: allocations, compiles, files, the device. Each call then returns an error that names what
// failed, nothing half-done stays behind, and the next attempt succeeds where one can.
#include <filesystem>
#include <fstream>

#include "LanternHost/ReferenceRenderer.h"
#include "LanternScene/ShaderTable/SectionTable.h"
#include "Support/CoreTestTools.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

using ::testing::HasSubstr;

constexpr FContent Everything{
    .bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bEmissive = true, .bSun = true, .bSky = true};

class FRendererFaultTest : public FRendererTest
{
protected:
	/// Names of what the device was asked to make room for.
	std::vector<std::string> GetAllocations()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			const bool bAllocation = Call.Kind == ERTMockCall::CreateBuffer || Call.Kind == ERTMockCall::CreateTexture ||
			                         Call.Kind == ERTMockCall::CreateGeometry || Call.Kind == ERTMockCall::CreateScene ||
			                         Call.Kind == ERTMockCall::CreateShaderTable || Call.Kind == ERTMockCall::ReserveShaderTable ||
			                         Call.Kind == ERTMockCall::MakeHostCopy;
			if (bAllocation) { Names.push_back(Call.Name); }
		}
		return Names;
	}
	/// Runs Step until it succeeds; every failure must be a clean shortage of memory.
	/// FailAt: which allocation from now on fails; counted down.
	template <class F>
	void Insist(F Step, uint32_t& Failures, uint32_t& FailAt)
	{
		for (int Attempt = 0; Attempt < 50; ++Attempt)
		{
			Mock().ClearCalls();
			const FRTStatus Status = Step();
			const std::vector<std::string> Names = GetAllocations();
			const uint32_t Failing = FailAt;
			FailAt -= std::min<uint32_t>(FailAt, static_cast<uint32_t>(Names.size()));
			if (Status) { return; }
			++Failures;
			ASSERT_EQ(Status.Code, ERTResult::OutOfDeviceMemory) << Status.Message;
			ASSERT_TRUE(Failing > 0 && Failing <= Names.size()) << Status.Message;
			// Several threads may have called in another order than they were served.
			const std::string Message = Status.Message;
			const auto IsNamed = [&](const std::string& Name) { return Message.find(Name) != std::string::npos; };
			ASSERT_TRUE(bOneThread ? IsNamed(Names[Failing - 1]) : std::any_of(Names.begin(), Names.end(), IsNamed)) << Message;
		}
		FAIL() << "does not recover";
	}
	template <class T>
	void ExpectOnDevice(FAddress Address, const TPagedArray<T>& Table, const char* What)
	{
		if (Table.IsEmpty()) { return; }
		IRTBuffer* const Buffer = Mock().FindBuffer(Address);
		ASSERT_TRUE(Buffer) << What;
		std::vector<T> Values(Table.Num());
		Table.CopyTo(Values.data(), 0, Values.size());
		EXPECT_EQ(std::memcmp(Mock().GetBytes(Buffer), Values.data(), Values.size() * sizeof(T)), 0) << What;
	}
	/// The device holds what the scene says, whatever failed on the way.
	void ExpectSceneOnDevice()
	{
		FRTScene& Scene = Engine->GetScene().GetScene();
		const FSceneConstants Constants = Scene.GetConstants();
		ExpectOnDevice(Constants.Materials, Scene.GetMaterials().All(), "materials");
		ExpectOnDevice(Constants.Sections, Scene.GetSections().GetTable().All(), "sections");
		EXPECT_EQ(Constants.LightCount, 1u);
		EXPECT_TRUE(Mock().FindBuffer(Constants.Lights));
		const auto Instances = Mock().GetSceneInstances(Unwrap(Scene.GetStructure()));
		EXPECT_EQ(Instances.size(), Scene.GetFacts().Objects);
		for (const FRTMockInstance& Item : Instances)
		{
			EXPECT_TRUE(Item.bBuilt && !Item.bDangling);
			const uint32_t Index = Item.Instance.CustomIndexAndMask & MaxInstanceIndex;
			uint64_t Offset = 0;
			IRTBuffer* const Objects = Mock().FindBuffer(Constants.Objects + Index * sizeof(FObjectData), &Offset);
			ASSERT_TRUE(Objects);
			FObjectData Data;
			std::memcpy(&Data, Mock().GetBytes(Objects) + Offset, sizeof(Data));
			EXPECT_EQ(std::memcmp(Data.ObjectToWorld, Item.Instance.Transform, sizeof(Item.Instance.Transform)), 0);
		}
		for (uint32_t Instance = 0; GetRTPSO() && Instance < Instances.size(); ++Instance)
		{
			for (uint32_t Type = 0; Type < GetRTPSO()->GetRayTypeCount(); ++Type)
			{
				EXPECT_TRUE(Resolve(Instance, Type).IsGood()) << Resolve(Instance, Type).Error;
			}
		}
	}
	/// Fails the first allocation, the second and so on, each in an engine of its own with Variables set.
	void FailEachAllocation(const std::vector<std::pair<const char*, const char*>>& Variables)
	{
		uint32_t Failed = 0;
		for (uint32_t N = 1;; ++N)
		{
			Open();
			for (const auto& [Name, Value] : Variables) { Set(Name, Value); }
			Mock().FailAllocation(N);
			uint32_t Failures = 0, FailAt = N;
			ASSERT_NO_FATAL_FAILURE(Insist([&] { return Load(Everything); }, Failures, FailAt)) << "allocation " << N;
			for (int Frame = 0; Frame < 3; ++Frame)
			{
				ASSERT_NO_FATAL_FAILURE(Insist([&] { return RenderFrame(Frame * 0.1); }, Failures, FailAt)) << "allocation " << N;
			}
			ASSERT_LE(Failures, 1u);
			ASSERT_NO_FATAL_FAILURE(ExpectSceneOnDevice()) << "allocation " << N;
			ASSERT_FALSE(HasFailure()) << "allocation " << N;
			if (Failures == 0 && N > 60) { break; } // that many there are not: all have been tried
			Failed += Failures;
		}
		EXPECT_GT(Failed, 30u);
	}
	bool bOneThread = false; ///< makes and records all of a frame

	FRTStatus RenderReferenceOnce()
	{
		FReferenceSettings Settings;
		Settings.View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 16, 8);
		Settings.Samples = 1;
		FReferenceResult Result;
		return RenderReference(*Engine, Settings, Result);
	}
};

TEST_F(FRendererFaultTest, EveryAllocationMayFailOnce)
{
	// Tasks allocate in no fixed order, so that another run would fail another allocation.
	bOneThread = true;
	for (const char* const Path : {"1", "2"})
	{
		EXPECT_NO_FATAL_FAILURE(FailEachAllocation(
		    {{"r.RT.Shadow.Path", Path}, {"r.RT.FrameGraph.Tasks", "0"}, {"r.RT.Scene.Hoist", "0"}, {"r.RT.SBT.Prebind", "0"}}));
	}
}

TEST_F(FRendererFaultTest, AllocationsOfTasksMayFail)
{
	EXPECT_NO_FATAL_FAILURE(FailEachAllocation({{"r.RT.Shadow.Path", "2"}, {"r.RT.Scene.Hoist", "1"}, {"r.RT.SBT.Prebind", "1"}}));
}

TEST_F(FRendererFaultTest, SkinningOfALostFrameIsDoneAgain)
{
	ASSERT_TRUE(Load(Everything));
	for (int Frame = 0; Frame < 4; ++Frame)
	{
		Engine->ExtraPasses = [](FFrameContext& Context, const FGBuffer&, const FFrameOutputs&) {
			Context.Fail(FRTStatus::Error(ERTResult::Unsupported, "on purpose"));
		};
		const FRTStatus Status = RenderFrame(Frame * 0.1);
		EXPECT_STREQ(Status.Message, "on purpose");
		Engine->ExtraPasses = {};
		Render(Frame * 0.1);
		EXPECT_TRUE(HasPass("Skinning")) << "frame " << Frame;
		ExpectSceneOnDevice();
	}
}

TEST_F(FRendererFaultTest, NothingIsRecordedBehindAFailedPass)
{
	// A pass may lack what the failed one was to make: a shader table, the scene's tables.
	ASSERT_TRUE(Load(Everything));
	Engine->ExtraPasses = [](FFrameContext& Context, const FGBuffer&, const FFrameOutputs&) {
		const auto Add = [&](const char* Name, FPassExecute Execute) {
			Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) {
				Builder.NeverCull();
				return Execute;
			});
		};
		Add("Fails", [&](FPassContext&) { Context.Fail(FRTStatus::Error(ERTResult::Unsupported, "on purpose")); });
		Add("Behind", [](FPassContext&) { ADD_FAILURE() << "was recorded"; });
	};
	EXPECT_STREQ(RenderFrame().Message, "on purpose");
	EXPECT_TRUE(HasPass("Fails"));
	EXPECT_FALSE(HasPass("Behind"));
	Engine->ExtraPasses = {};
	Render();
	ExpectSceneOnDevice();
}

TEST_F(FRendererFaultTest, MemoryThatIsShortForLongIsNoDisaster)
{
	Mock().FailEveryAllocation(3);
	// Loading needs more than two allocations in a row, so it cannot succeed.
	for (int I = 0; I < 5; ++I) { EXPECT_EQ(Load(Everything).Code, ERTResult::OutOfDeviceMemory); }
	Mock().FailEveryAllocation(0);
	ASSERT_TRUE(Load(Everything));
	Mock().FailEveryAllocation(1);
	for (int I = 0; I < 5; ++I) { EXPECT_EQ(RenderFrame(I).Code, ERTResult::OutOfDeviceMemory); }
	Mock().FailEveryAllocation(0);
	Render();
	ExpectSceneOnDevice();
}

TEST_F(FRendererFaultTest, ReferenceSurvivesFailedAllocations)
{
	uint32_t Failed = 0;
	for (uint32_t N = 1; N < 40; ++N)
	{
		Open();
		uint32_t Failures = 0, FailAt = N;
		ASSERT_TRUE(Load(Everything));
		Mock().FailAllocation(N);
		ASSERT_NO_FATAL_FAILURE(Insist([&] { return RenderReferenceOnce(); }, Failures, FailAt)) << "allocation " << N;
		Mock().FailAllocation(0);
		ExpectSceneOnDevice();
		Failed += Failures;
	}
	EXPECT_GT(Failed, 8u);
}

TEST_F(FRendererFaultTest, PipelineThatDoesNotCompileIsNamed)
{
	for (const char* Name :
	    {"RTPSO", "GBuffer", "GBufferMasked", "Lighting/DirectLighting.comp", "ToneMap/ToneMap.comp", "Skinning/Skin.comp"})
	{
		Open();
		Set("r.RT.Shadow.Path", "1");
		ASSERT_TRUE(Load(Everything));
		Mock().FailCompile(Name);
		for (int I = 0; I < 3; ++I)
		{
			const FRTStatus Status = RenderFrame();
			EXPECT_EQ(Status.Code, ERTResult::CompileFailed) << Name;
			EXPECT_THAT(std::string(Status.Message), HasSubstr(Name));
		}
	}
}

TEST_F(FRendererFaultTest, PipelineWithoutMemoryIsNamedAndComesOnceThereIsMemory)
{
	Set("r.RT.Shadow.Path", "1");
	LoadAndRender(Everything);
	std::vector<std::string> Names;
	for (const std::string& Name : Mock().GetCreatedPipelines()) { Names.push_back(Name); }
	ASSERT_THAT(Names, ::testing::IsSupersetOf({"RTPSO", "GBuffer", "GBufferMasked", "Skinning/Skin.comp", "ToneMap/ToneMap.comp"}));
	std::sort(Names.begin(), Names.end());
	Names.erase(std::unique(Names.begin(), Names.end()), Names.end());
	for (const std::string& Name : Names)
	{
		SCOPED_TRACE(Name);
		Open();
		ASSERT_TRUE(Load(Everything));
		Mock().StarveCompiles(Name);
		for (int I = 0; I < 3; ++I)
		{
			const FRTStatus Status = RenderFrame();
			EXPECT_EQ(Status.Code, ERTResult::OutOfDeviceMemory);
			EXPECT_THAT(std::string(Status.Message), HasSubstr(Name));
		}
		Mock().ClearCompileFaults();
		ASSERT_NO_FATAL_FAILURE(Render());
		EXPECT_TRUE(HasPass("SunShadow"));
		EXPECT_TRUE(HasPass("ToneMap"));
		ExpectSceneOnDevice();
	}
}

TEST_F(FRendererFaultTest, FeatureWhosePipelineFailsCanBeSwitchedOff)
{
	Mock().FailCompile("RTPSO");
	Mock().FailCompile("Rays/ShadowQueue.comp");
	Set("r.RT.Lights", "0"); // their rays have this pipeline, too
	ASSERT_TRUE(Load(Everything));
	for (const char* Path : {"1", "2"})
	{
		Set("r.RT.Shadow.Path", Path);
		EXPECT_EQ(RenderFrame().Code, ERTResult::CompileFailed);
		Set("r.RT.Shadow", "0");
		Render();
		EXPECT_FALSE(HasPass("SunShadow"));
		Set("r.RT.Shadow", "1");
	}
	Mock().ClearCalls();
	EXPECT_EQ(RenderFrame().Code, ERTResult::CompileFailed);
	EXPECT_EQ(Mock().CountCalls(ERTMockCall::CreateComputePipeline), 0u) << "what failed to compile is not tried each frame";
	// Another pipeline of the same feature is not the one that failed.
	Mock().ClearCompileFaults();
	Set("r.RT.Shadow.Path", "1");
	Set("r.RT.AlphaTest", "0");
	Render();
	EXPECT_TRUE(HasPass("SunShadow"));
	ExpectSceneOnDevice();
}

TEST_F(FRendererFaultTest, MissingShaderFileIsNamed)
{
	for (const char* Missing : {"Lighting/DirectLighting.comp", "Tiles/Tiles.comp", "Tiles/QueueSun.comp", "Rays/OrderThreads.comp",
	         "SunShadow/SunShadow.comp", "Rays/ShadowQueue.rgen", "Rays/Shadow.rmiss", "GBuffer/GBuffer.frag", "Library/Brdf.glsl"})
	{
		const FTemporaryFolder Folder;
		std::filesystem::copy(GetShaderFolder(), Folder.GetPath(), std::filesystem::copy_options::recursive);
		std::filesystem::remove(Folder.GetPath() + "/" + Missing);
		Open({}, {Folder.GetPath()});
		Set("r.RT.Shadow.Path", "1");
		ASSERT_TRUE(Load(Everything));
		const FRTStatus Status = RenderFrame();
		EXPECT_EQ(Status.Code, ERTResult::CompileFailed) << Missing;
		const std::string Name = std::filesystem::path(Missing).filename().string();
		EXPECT_THAT(std::string(Status.Message), HasSubstr(Name));
	}
}

TEST_F(FRendererFaultTest, WrongShaderIsNamedWithItsLine)
{
	const FTemporaryFolder Folder;
	std::filesystem::copy(GetShaderFolder(), Folder.GetPath(), std::filesystem::copy_options::recursive);
	std::ofstream(Folder.GetPath() + "/ToneMap/ToneMap.comp") << "#version 460\n\nvoid main() { nonsense; }\n";
	Open({}, {Folder.GetPath()});
	ASSERT_TRUE(Load({}));
	const FRTStatus Status = RenderFrame();
	EXPECT_EQ(Status.Code, ERTResult::CompileFailed);
	EXPECT_THAT(std::string(Status.Message), HasSubstr("ToneMap/ToneMap.comp:3"));
}

// ---------------------------------------------------------------------------------------------------- device lost

class FDeviceLostTest : public FRendererFaultTest, public ::testing::WithParamInterface<int>
{};

TEST_P(FDeviceLostTest, EveryCallSaysSoAndNothingHangs)
{
	const auto Kind = static_cast<ERTMockCall>(GetParam());
	for (const int Phase : {0, 1, 2, 3}) // while loading, in the first frame, in a later one, in the reference
	{
		for (const char* Path : {"1", "2"})
		{
			Open();
			Set("r.RT.Shadow.Path", Path);
			FRTStatus Status;
			const auto Do = [&](int At, auto Step) {
				if (At == Phase) { Mock().LoseDeviceAt(Kind); }
				if (Status) { Status = Step(); }
				const bool bLost = Device->WaitFor(0, 0).Code == ERTResult::DeviceLost;
				EXPECT_EQ(Status.IsOk(), !bLost) << Status.Message;
				if (!Status) { EXPECT_EQ(Status.Code, ERTResult::DeviceLost) << Status.Message; }
			};
			Do(0, [&] { return Load(Everything); });
			Do(1, [&] { return RenderFrame(0.0); });
			Do(2, [&] { return RenderFrame(0.1); });
			Do(3, [&] { return RenderReferenceOnce(); });
			if (Status) { continue; } // this kind of call is not made then
			// Trying on fails in the same way, as often as one likes.
			for (int I = 0; I < 3; ++I)
			{
				EXPECT_EQ(Load(Everything).Code, ERTResult::DeviceLost);
				EXPECT_EQ(Engine->GetRenderer().WaitForAll().Code, ERTResult::DeviceLost);
			}
		}
	}
}

TEST_P(FDeviceLostTest, FramesAfterTheLossFailToo)
{
	ASSERT_TRUE(Load(Everything));
	ASSERT_TRUE(RenderFrame(0.0));
	Mock().LoseDeviceAt(static_cast<ERTMockCall>(GetParam()));
	bool bLost = false;
	for (int I = 1; I < 5; ++I)
	{
		const FRTStatus Status = RenderFrame(0.1 * I);
		EXPECT_TRUE(!bLost || !Status) << "a frame of a lost device";
		bLost |= !Status;
		if (!Status) { EXPECT_EQ(Status.Code, ERTResult::DeviceLost) << Status.Message; }
	}
}

INSTANTIATE_TEST_SUITE_P(Calls, FDeviceLostTest, ::testing::Range(0, static_cast<int>(ERTMockCall::EndMarker) + 1));

} // namespace
} // namespace Lantern
