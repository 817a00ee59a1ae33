// A flight at 200 m/s over the world: memory stays bounded, nothing dangles, nothing is missing for long.
#include <cstdlib>

#include "LanternScene/ShaderTable/SectionTable.h"
#include "StreamingWorld.h"
#include "Support/RendererTestTools.h"

namespace Lantern
{
namespace
{

double GetScale()
{
	const char* const Text = std::getenv("LANTERN_STRESS_SCALE");
	return Text ? std::max(0.01, std::atof(Text)) : 1.0;
}

class FStreamingTest : public FRendererTest
{
protected:
	struct FMost
	{
		uint64_t Bytes = 0;
		uint32_t Objects = 0, Sections = 0, LiveObjects = 0;
	};
	void Note(FMost& Most)
	{
		Most.Bytes = std::max(Most.Bytes, Inner->GetMemoryStats().Total);
		Most.LiveObjects = std::max(Most.LiveObjects, Mock().GetLiveObjectCount());
		Most.Sections = std::max(Most.Sections, Engine->GetScene().GetScene().GetSections().GetCapacity());
		Most.Objects = std::max(Most.Objects, Engine->GetScene().GetScene().GetFacts().Objects);
	}
	/// Every instance of the scene has a good record for each ray type.
	void ExpectGoodRecords()
	{
		const auto Instances = Mock().GetSceneInstances(Unwrap(Engine->GetScene().GetScene().GetStructure()));
		EXPECT_GT(Instances.size(), 10u);
		for (uint32_t Instance = 0; Instance < Instances.size(); ++Instance)
		{
			EXPECT_TRUE(Instances[Instance].bBuilt && !Instances[Instance].bDangling);
			for (uint32_t Type = 0; GetRTPSO() && Type < GetRTPSO()->GetRayTypeCount(); ++Type)
			{
				const FRTMockRecord Record = ResolveIn(Instances[Instance], Type);
				ASSERT_TRUE(Record.IsGood()) << Record.Error;
			}
		}
	}
	FRTMockRecord ResolveIn(const FRTMockInstance& Instance, uint32_t Type)
	{
		IRTShaderTable* const Table = Unwrap(Engine->GetRenderer().GetShaderTable().GetTable());
		return Mock().ResolveHit(Table, Instance.Instance, 0, Type, GetRTPSO()->GetRayTypeCount());
	}
};

TEST_F(FStreamingTest, FlightHasBoundedMemory)
{
	Set("r.RT.Shadow.Path", "1");
	ASSERT_TRUE(Load({.bObjects = true}));
	ASSERT_NO_FATAL_FAILURE(Render()); // the pipeline is there
	Engine->bRealTime = true;
	Mock().SetCallRecording(false);
	FStreamingWorld World(*Device, Engine->GetScene().GetScene(), {});
	constexpr double FramesPerSecond = 30.0;
	const int Frames = static_cast<int>(60.0 * FramesPerSecond * GetScale());
	FMost Early, Late;
	for (int Frame = 0; Frame < Frames; ++Frame)
	{
		const glm::dvec3 Camera = FStreamingWorld::FlightAt(Frame / FramesPerSecond);
		const FRTStatus Moved = World.MoveTo(Camera);
		ASSERT_TRUE(Moved) << Moved.Message;
		const glm::dvec3 Ahead = FStreamingWorld::FlightAt((Frame + 1) / FramesPerSecond) - Camera;
		const FRTStatus Rendered = Engine->RenderFrame(LookAt(Camera, Camera + Ahead, 1.0f, 40, 24), 0.0, {}, nullptr);
		ASSERT_TRUE(Rendered) << "frame " << Frame << ": " << Rendered.Message;
		Note(Frame < Frames / 4 ? Early : Late);
		if (Frame % 300 == 299) { ExpectGoodRecords(); }
		if (HasFailure()) { FAIL() << "frame " << Frame; }
	}
	RecordProperty("TilesLoaded", std::to_string(World.GetTilesLoaded()));
	// The flight keeps a steady number of tiles: what is more than fluctuation is a leak.
	EXPECT_LE(Late.Bytes, Early.Bytes + Early.Bytes / 4) << "bytes on the device";
	EXPECT_LE(Late.LiveObjects, Early.LiveObjects + Early.LiveObjects / 4) << "live RHI objects";
	EXPECT_LE(Late.Sections, Early.Sections + Early.Sections / 4) << "sections";
	EXPECT_LE(Late.Objects, Early.Objects + Early.Objects / 4) << "objects";
	EXPECT_LE(Engine->GetScene().GetScene().GetMaterials().Num(), 400u) << "materials";
}

} // namespace
} // namespace Lantern
