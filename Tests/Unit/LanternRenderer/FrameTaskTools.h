// For tests of the frame beside its tasks: workers that a test keeps busy, and frames told apart by what they recorded.
#pragma once

#include <condition_variable>
#include <random>

#include "LanternCore/Tasks/TaskTrace.h"
#include "Support/RendererTestTools.h"
#include "Support/WakeWorkers.h"

namespace Lantern
{

inline constexpr FContent Everything{.bMasked = true, .bSkinned = true, .bLights = true, .bTexture = true, .bEmissive = true, .bSky = true};

/// Keeps all of TBB's workers but the calling thread busy until Open.
class FBlockedWorkers
{
public:
	FBlockedWorkers()
	{
		const size_t Workers = GetWorkerCount() - 1;
		for (size_t I = 0; I < Workers; ++I)
		{
			Group.Run([this] {
				std::unique_lock Lock(Mutex);
				++Blocked;
				Changed.wait(Lock, [&] { return bOpen; });
			});
		}
		const auto CountBlocked = [this] {
			const std::lock_guard Lock(Mutex);
			return Blocked;
		};
		const auto Describe = [&] { return std::to_string(CountBlocked()) + " of " + std::to_string(Workers); };
		bAllBlocked = WaitUntil(
		    "workers to be kept busy", [&] { return CountBlocked() == Workers; }, std::ref(Wake), Describe);
	}
	~FBlockedWorkers() { Open(); }
	bool AreAllBlocked() const { return bAllBlocked; }
	void Open()
	{
		{
			std::lock_guard Lock(Mutex);
			bOpen = true;
		}
		Changed.notify_all();
		Group.Wait();
	}

private:
	std::mutex Mutex;
	std::condition_variable Changed;
	size_t Blocked = 0;
	bool bOpen = false, bAllBlocked = false;
	FWakeWorkers Wake;
	FTaskGroup Group;
};

class FFrameTaskTest : public FRendererTest
{
protected:
	void SetUp() override
	{
		FRendererTest::SetUp();
		Set("r.RT.Shadow.Path", "1");
	}
	void TearDown() override
	{
		GBufferPass.reset();
		FTaskTrace::Stop();
		FTaskTrace::Clear();
		FRendererTest::TearDown();
	}
	FRTScene& GetScene() { return Engine->GetScene().GetScene(); }
	static void SetToggles(int Combination)
	{
		if (FConsoleVariables::Get().Find("r.RT.Scene.Hoist")) { Set("r.RT.Scene.Hoist", Combination & 1 ? "1" : "0"); }
		Set("r.RT.SBT.Prebind", Combination & 2 ? "1" : "0");
	}
	static constexpr int Combinations = 4;
	static void SetRecordingTasks(bool bTasks) { Set("r.RT.FrameGraph.Tasks", bTasks ? "1" : "0"); }

	/// What a frame's rays would find: transforms, and the shaders and data of every record.
	std::string DescribeRays()
	{
		std::string Text;
		const std::vector<FRTMockInstance> Instances = Mock().GetSceneInstances(Unwrap(GetScene().GetStructure()));
		for (uint32_t I = 0; I < Instances.size(); ++I)
		{
			const FRTMockRecord Record = Resolve(I, 0);
			EXPECT_TRUE(Record.IsGood()) << Record.Error;
			Text += Instances[I].GeometryName + ' ' + Record.AnyHit + " :";
			for (const float Value : Instances[I].Instance.Transform) { Text += ' ' + std::to_string(Value); }
			Text += '\n';
		}
		return Text;
	}
	/// Recorded calls without what follows from addresses, or from which thread first asked for memory of the frame.
	std::vector<std::string> DescribeCalls()
	{
		std::vector<std::string> Lines;
		for (const FRTMockCall& Call : Mock().GetCalls())
		{
			if (Call.List.empty()) { continue; }
			std::string Line = std::to_string(static_cast<int>(Call.Kind)) + ' ' + Call.Name;
			FRTMockNumbers Numbers = Call.Numbers;
			if (Call.Kind == ERTMockCall::CopyBuffer) { Numbers[1] = 0; } // source offset
			for (const uint64_t Number : Numbers) { Line += ' ' + std::to_string(Number); }
			Lines.push_back(Line + ' ' + std::to_string(Call.Bytes.size()));
		}
		return Lines;
	}
	/// One frame of a short film in which something of everything changes.
	void ChangeScene(int Frame)
	{
		FHostScene& Host = Engine->GetScene();
		glm::dmat4 Transform(1.0);
		Transform[3] = glm::dvec4(0.1 * Frame, 0, 0, 1);
		Host.SetTransform(0, Transform);
		if (Frame == 2) { Added = GetScene().AddObject(GetScene().GetObject(Host.GetDraws()[1].Object)); }
		if (Frame == 4) { GetScene().SetMaterials(Added, {0}); }
		if (Frame == 6) { GetScene().RemoveObject(Added); }
		if (Frame == 7)
		{
			FMaterialData Material = GetScene().GetMaterials()[1];
			Material.Flags ^= MATERIAL_MASKED;
			GetScene().SetMaterial(1, Material);
		}
	}
	/// A frame of the host's own, with Before added in front of all that traces.
	FRTStatus RenderWith(const std::function<void(FFrameContext&)>& Before)
	{
		FRenderer& Renderer = Engine->GetRenderer();
		FView View = LookAt({0, 0, 5}, {0, 0, 0}, 1.0f, 40, 24);
		View.FrameIndex = FrameIndex++;
		FConsoleVariables::Get().BeginFrame();
		if (FRTStatus S = Renderer.BeginFrame(GetScene(), View, {}); !S) { return S; }
		FFrameContext& Context = Renderer.GetContext();
		if (!GBufferPass) { GBufferPass = std::make_unique<FGBufferPass>(Renderer); }
		const FGBuffer GBuffer = GBufferPass->Add(Context, Engine->GetScene());
		Before(Context);
		const FFrameOutputs Frame = AddFramePasses(Context, GBuffer);
		Context.Graph.AddPass("Use", [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			Builder.Read(Frame.Display, ERTAccess::ShaderRead);
			return {};
		});
		return Renderer.EndFrame(nullptr);
	}
	static void AddPass(FFrameContext& Context, const char* Name, const std::function<void()>& Do)
	{
		Context.Graph.AddPass(Name, [&](FPassBuilder& Builder) -> FPassExecute {
			Builder.NeverCull();
			return [Do](FPassContext&) { Do(); };
		});
	}
	static size_t CountEvents(const std::string& Name)
	{
		const std::vector<FTraceEvent> Events = FTaskTrace::GetEvents();
		return std::count_if(Events.begin(), Events.end(), [&](const auto& Event) { return Name == Event.Name; });
	}
	static FTraceEvent FindEvent(const std::string& Name)
	{
		for (const FTraceEvent& Event : FTaskTrace::GetEvents())
		{
			if (Name == Event.Name) { return Event; }
		}
		ADD_FAILURE() << "no event " << Name;
		return {};
	}
	bool WaitForEvent(const std::string& Name)
	{
		return WaitUntil(
		    "the task " + Name, [&] { return CountEvents(Name) > 0; }, std::ref(Wake));
	}
	void StartTrace()
	{
		Set("r.RT.Trace.File", "/nonexistent/trace.json");
		Set("r.RT.Trace", "1");
	}

	FWakeWorkers Wake;
	FRTObjectId Added;
	std::unique_ptr<FGBufferPass> GBufferPass;
	uint32_t FrameIndex = 0;
};

} // namespace Lantern
