// Paths that are followed although a radiance cell has answered: what they find is the truth, says how wrong cells are, and corrects them.
#include "CachedGIFixture.h"
#include "LanternRenderer/RadianceAudit.h"

namespace Lantern
{

namespace
{

class FCellAuditTest : public FCachedGITest
{
protected:
	static constexpr uint32_t AllBounces = 64;

	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
	}

	static FRadianceAudit TakeAudit()
	{
		EXPECT_TRUE(GetEngine().GetRenderer().WaitForAll());
		return GetEngine().GetRenderer().GetRadianceAudit();
	}

	const FView WallView = LookAtGlossyWall();
};

TEST_F(FCellAuditTest, CorrectedCellsAreWithoutBias)
{
	REQUIRE_SCENE(Scene, "cornell/cornell.gltf");
	SetVariable("r.RT.GI.Cells.SizeAngle", "1"); // many look-ups fail, others are wrong, and paths get lost
	ASSERT_TRUE(Load(Scene));
	const FView View = MakeView(48, 48);
	SetVariable("r.RT.GI.Denoise", "1"); // it does not count with corrections
	SetVariable("r.RT.GI.Residual", "2");
	ExpectUnbiased("corrected cells", ESignal::DiffuseGI, View, 192, 256, AllBounces, 0.005);
	const double Corrected = MeanGreen(RenderSettled(View, 48));
	SetVariable("r.RT.GI.Residual", "0");
	const double Ratio = MeanGreen(RenderSettled(View, 48)) / Corrected;
	PrintFigure(fmt::format("the same cells without correction: {:.4f} of it", Ratio));
	EXPECT_LT(Ratio, 0.95) << "else there is nothing to correct";
}

// Without the chance, seven eighths of what cells lack stay missing.
TEST_F(FCellAuditTest, ChanceOfCorrectionCounts)
{
	LoadGlossyWall(false);
	const double Reference = MeanGreen(TraceSignal(ESignal::DiffuseGI, WallView, 1024, AllBounces));
	const auto Measure = [&](const char* Residual, const char* Chance) {
		SetVariable("r.RT.GI.Residual", Residual);
		SetVariable("r.RT.Debug.GI.ResidualChance", Chance);
		return MeanGreen(RenderSettled(WallView, 256)) / Reference;
	};
	const double Cells = Measure("0", "1"), Corrected = Measure("2", "1"), Wrong = Measure("2", "0");
	PrintFigure(fmt::format("wrong cells / reference {:.4f}, corrected {:.4f}, without the chance {:.4f}", Cells, Corrected, Wrong));
	EXPECT_LT(Cells, 0.85);
	EXPECT_NEAR(Corrected, 1.0, 0.02); // for the noise of both pictures: without a correction, a sixth is missing
	EXPECT_LT(Wrong, 0.9);
}

TEST_F(FCellAuditTest, AuditSaysHowWrongCellsAre)
{
	LoadGlossyWall(false);
	const double Reference = MeanGreen(TraceSignal(ESignal::DiffuseGI, WallView, 1024, AllBounces));
	const uint32_t FramesBefore = TakeAudit().Frames;
	const FImage Unaudited = RenderSettled(WallView, 64);
	EXPECT_EQ(TakeAudit().Frames, FramesBefore) << "nothing is followed unless asked for";
	LoadGlossyWall(false);
	SetVariable("r.RT.GI.Residual", "1");
	RenderSignal(ESignal::DiffuseGI, WallView, WarmFrames);
	const FRadianceAudit Before = TakeAudit();
	const FImage Audited = RenderSignal(ESignal::DiffuseGI, WallView, 64, WarmFrames);
	// The second launch may round otherwise than the first.
	EXPECT_EQ(FractionDiffering(Unaudited, Audited, 1.0e-3), 0.0) << "an audit does not change what it audits";
	FRadianceAudit Audit = TakeAudit();
	Audit -= Before;
	const FRadianceAuditSums All = Audit.GetAll();
	const double Ratio = MeanGreen(Audited) / Reference;
	PrintFigure(fmt::format("cells / reference {:.4f}; times the audit's ratio {:.4f}, whose standard error is {:.4f}, {} paths", Ratio,
	    Ratio * All.GetRatio(), All.GetStandardError(), All.Paths));
	EXPECT_LT(Ratio, 0.85);
	EXPECT_LT(All.GetStandardError(), 0.03);
	// The reference has noise as well.
	EXPECT_NEAR(Ratio * All.GetRatio(), 1.0, 0.01 + 3.0 * All.GetStandardError());
	EXPECT_EQ(Audit.Frames, 64u);
	EXPECT_EQ(Audit.Leaves.Paths, 0.0);
}

// Leaves share a cell with both of their sides. One of them faces the light. The planted fault gives both the mean.
TEST_F(FCellAuditTest, LeavesShareTheirCellsRightly)
{
	SetVariable("r.RT.GI.Cells.SizeAngle", "0.02");
	SetVariable("r.RT.GI.Cells.UpdatesPerSecond", "1000000");
	SetVariable("r.RT.GI.Residual", "1");
	for (const bool bDirection : {true, false})
	{
		ASSERT_TRUE(Load("leaves"));
		const FView View = MakeView(96, 54);
		SetVariable("r.RT.Debug.GI.CellDirection", bDirection ? "1" : "0");
		RenderSignal(ESignal::DiffuseGI, View, WarmFrames);
		const FRadianceAudit Before = TakeAudit();
		RenderSignal(ESignal::DiffuseGI, View, 96, WarmFrames);
		FRadianceAudit Audit = TakeAudit();
		Audit -= Before;
		const FRadianceAuditSums& Leaves = Audit.Leaves;
		PrintFigure(fmt::format("leaves, cells with directions {}: followed / answered {:.4f}, standard error {:.4f}, {} paths; all {:.4f}",
		    bDirection, Leaves.GetRatio(), Leaves.GetStandardError(), Leaves.Paths, Audit.GetAll().GetRatio()));
		EXPECT_GT(Leaves.Paths, 5000.0);
		EXPECT_LT(Leaves.GetStandardError(), 0.03);
		// As surfaces that know their side, they had 0.885.
		if (bDirection) { EXPECT_NEAR(Leaves.GetRatio(), 1.0, 0.045 + 2.0 * Leaves.GetStandardError()); }
		else { EXPECT_GT(Leaves.GetRatio(), 1.07); }
	}
}

} // namespace
} // namespace Lantern
