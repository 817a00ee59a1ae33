// Which look-up gives a radiance cell its place, where votes are equal.
#include <algorithm>
#include <cstring>

#include "RadianceCellTypes.h"
#include "Support/RenderFixture.h"

namespace Lantern
{

namespace
{
/// A table of one bucket with one cell, in slot 0, and the notes of those who have voted for it.
class FRadianceVoteTest : public FRenderTest
{
protected:
	static constexpr uint32_t Voters = 8;

	struct FTable
	{
		FRadianceGrid Grid;
		uint32_t Keys[RADIANCE_CELL_BUCKET];
		FRadianceCell Cells[RADIANCE_CELL_BUCKET];
		FRadianceCellCounters Counters;
		FRadianceVote Votes[Voters];
		FRadianceVote UpdateVotes[RADIANCE_CELL_MOST_UPDATES];
	};

	void SetUp() override
	{
		FRenderTest::SetUp();
		ASSERT_OK(GetDevice().CreateBuffer(
		    {sizeof(FTable), ERTBufferUsage::Storage, ERTMemory::Readback, "Table"}, Buffer.ReleaseAndGetAddress()));
		std::memset(Buffer->GetMapped(), 0, sizeof(FTable));
		FTable& Table = GetTable();
		const FAddress At = Buffer->GetDeviceAddress();
		Table.Grid.Keys = At + offsetof(FTable, Keys);
		Table.Grid.Cells = At + offsetof(FTable, Cells);
		Table.Grid.Counters = At + offsetof(FTable, Counters);
		Table.Grid.Votes = At + offsetof(FTable, Votes);
		Table.Grid.UpdateVotes = At + offsetof(FTable, UpdateVotes);
		Table.Grid.VoteCount = Voters;
		Table.Grid.AskedTurns = Table.Grid.Life = Table.Grid.LeastWait = Table.Grid.Rounds = 1;
		Table.Keys[0] = 0x80000005; // of an earlier frame
		for (FRadianceVote& Vote : Table.Votes) { Vote.Slot = NO_RADIANCE_CELL; }
	}

	FTable& GetTable() const { return *static_cast<FTable*>(Buffer->GetMapped()); }

	/// Place: of the look-up, x.
	void Vote(uint32_t Voter, uint32_t Value, int32_t Place)
	{
		GetTable().Votes[Voter] = {0, Value, {Place, 0, 0}, 0, 0};
		GetTable().Cells[0].Vote = std::max(GetTable().Cells[0].Vote, Value);
	}

	void Run(const char* Name)
	{
		IRTPipeline* Pipeline = nullptr;
		ASSERT_OK(GetEngine().GetRenderer().GetPipelines().Get({Name, ERTShaderStage::Compute}, Pipeline));
		FRadianceCellConstants C{};
		C.Grid = Buffer->GetDeviceAddress();
		Dispatch(Pipeline, &C, sizeof(C), 1, 1, Buffer.Get());
	}

	TRTRef<IRTBuffer> Buffer;
};

constexpr uint32_t Near = 6u << 29 | 1000, Far = 5u << 29 | 5000; ///< votes of rank 1 and 2

// Threads come in any order: the last writer must not decide. Lavapipe runs the threads of a work group from the first to the last.
TEST_F(FRadianceVoteTest, FirstOfEqualVotesWins)
{
	Vote(1, Far, 10);
	Vote(3, Near, 30);
	Vote(5, Near, 50);
	Vote(6, Near, 60);
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Votes.comp"));
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Age.comp"));
	EXPECT_EQ(GetTable().Cells[0].Place.x, 30);
	EXPECT_EQ(GetTable().Cells[0].Vote, 0u);
	EXPECT_EQ(GetTable().Keys[0], 0x80000005u);
}

// Notes of updates come behind those of pixels.
TEST_F(FRadianceVoteTest, PixelsComeBeforeUpdates)
{
	GetTable().UpdateVotes[2] = {0, Near, {20, 0, 0}, 0, 0};
	Vote(4, Far, 40);
	GetTable().Cells[0].Vote = Near;
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Votes.comp"));
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Age.comp"));
	EXPECT_EQ(GetTable().Cells[0].Place.x, 20) << "the greater vote, of an update";

	Vote(4, Near, 41);
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Votes.comp"));
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Age.comp"));
	EXPECT_EQ(GetTable().Cells[0].Place.x, 41) << "the first of equal ones";
}

// A look-up from further away does not move a cell that a nearer one has given its place, unless its hash is a multiple of 64.
TEST_F(FRadianceVoteTest, CellWithoutAClaimKeepsItsPlace)
{
	GetTable().Cells[0].State = 9; // updates
	GetTable().Cells[0].Place.x = 7;
	Vote(2, Far, 20);
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Votes.comp"));
	ASSERT_NO_FATAL_FAILURE(Run("RadianceCells/Age.comp"));
	EXPECT_EQ(GetTable().Cells[0].Place.x, 7);
	EXPECT_EQ(GetTable().Cells[0].Vote, 0u);
}

} // namespace
} // namespace Lantern
