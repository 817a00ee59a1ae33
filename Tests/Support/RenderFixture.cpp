// The device and the engine of render tests, pictures of scenes, and figures from pictures.
#include "RenderFixture.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/BuiltinScenes.h"
#include "LanternHost/SceneLoader.h"
#include "LanternRHIValidation/ValidationDevice.h"
#include "LanternRHIVulkan/VulkanDevice.h"

namespace Lantern
{

namespace
{
namespace fs = std::filesystem;

/// The device and the engine of the process; opened by the first test, closed after the last.
class FRenderWorld : public ::testing::Environment
{
public:
	FRTStatus Open()
	{
		if (Engine) { return FRTStatus::Success(); }
		FRTVulkanDeviceDesc Desc;
		Desc.bValidation = std::getenv("LANTERN_TEST_WITHOUT_LAYERS") == nullptr;
		Desc.MessageUser = this;
		Desc.MessageCallback = [](void* User, ERTVulkanMessage Severity, const char* Text) {
			if (Severity != ERTVulkanMessage::Info) { static_cast<FRenderWorld*>(User)->AddMessage(Text); }
		};
		TRTRef<IRTDevice> Inner;
		if (FRTStatus S = CreateVulkanDevice(Desc, Inner.ReleaseAndGetAddress()); !S) { return S; }
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FRenderWorld*>(User)->AddMessage(Text); };
		if (FRTStatus S = WrapWithValidation(Inner.Get(), OnMessage, this, Device.ReleaseAndGetAddress()); !S) { return S; }
		FRendererDesc Renderer;
		Renderer.ShaderFolders = {LANTERN_SOURCE_DIR "/Shaders"};
		Renderer.CacheFolder = LANTERN_TEST_CACHE;
		Engine = std::make_unique<FSampleEngine>(*Device, std::move(Renderer));
		return FRTStatus::Success();
	}

	/// Destroying everything may bring messages too: leaks, objects still in use.
	void TearDown() override
	{
		Engine.reset();
		Device.Reset();
		ReportMessages();
	}

	void AddMessage(const char* Text)
	{
		std::lock_guard Lock(Mutex);
		Messages.push_back(Text);
	}
	void ReportMessages()
	{
		std::lock_guard Lock(Mutex);
		for (const std::string& Message : Messages) { ADD_FAILURE() << "validation: " << Message; }
		Messages.clear();
	}

	TRTRef<IRTDevice> Device;
	std::unique_ptr<FSampleEngine> Engine;

private:
	std::mutex Mutex;
	std::vector<std::string> Messages;
};

FRenderWorld& GetWorld()
{
	// GoogleTest owns and deletes it.
	static auto* const World = static_cast<FRenderWorld*>(::testing::AddGlobalTestEnvironment(new FRenderWorld));
	return *World;
}
// Environments must be known before the tests start.
[[maybe_unused]] const FRenderWorld& RegisteredWorld = GetWorld();
} // namespace

std::string FindScene(const std::string& Name)
{
	fs::path Folder = fs::path(LANTERN_SOURCE_DIR).parent_path() / "shared" / "scenes";
	if (const char* Shared = std::getenv("LANTERN_SHARED")) { Folder = fs::path(Shared) / "scenes"; }
	if (const char* Scenes = std::getenv("LANTERN_SCENES")) { Folder = Scenes; }
	std::error_code Error;
	return fs::exists(Folder / Name, Error) ? (Folder / Name).string() : std::string();
}

FEstimate MakeEstimate(const std::vector<double>& Values)
{
	FEstimate Estimate;
	for (const double Value : Values) { Estimate.Mean += Value / double(Values.size()); }
	double Squares = 0.0;
	for (const double Value : Values) { Squares += (Value - Estimate.Mean) * (Value - Estimate.Mean); }
	Estimate.StandardError = std::sqrt(Squares / double(Values.size() * (Values.size() - 1)));
	return Estimate;
}

void PrintFigure(const std::string& Text)
{
	std::printf("[  figure  ] %s\n", Text.c_str());
	std::fflush(stdout);
}

void ExpectClosedForm(const char* What, const FEstimate& Estimate, double Expected, double Tolerance)
{
	const double Error = Estimate.Mean / Expected - 1.0, Sigma = Estimate.StandardError / Expected;
	PrintFigure(fmt::format("{}: expected {:.6g}, got {:.6g}, off by {:+.3f} % (statistical error {:.3f} %)", What, Expected, Estimate.Mean,
	    100 * Error, 100 * Sigma));
	EXPECT_LE(std::abs(Error), Tolerance) << What;
	EXPECT_LE(Sigma, Tolerance / 3) << What << ": too few samples to tell";
}

void FRenderTest::SetUp()
{
	ASSERT_OK(GetWorld().Open());
	FConsoleVariables::Get().ResetAll();
	// Pictures are of one frame, or means of several that know nothing of each other.
	SetVariable("r.RT.Shadow.Denoise", "0");
}

void FRenderTest::TearDown()
{
	if (!GetWorld().Engine) { return; }
	GetEngine().ExtraPasses = {};
	EXPECT_OK(GetEngine().GetRenderer().WaitForAll());
	GetWorld().ReportMessages();
}

IRTDevice& FRenderTest::GetDevice() { return *GetWorld().Device; }
FSampleEngine& FRenderTest::GetEngine() { return *GetWorld().Engine; }

bool FRenderTest::Load(const std::string& Name)
{
	FLoadResult Result = LoadScene(Name);
	EXPECT_TRUE(Result.Scene.has_value()) << Result.Error;
	return Result.Scene && Load(std::move(*Result.Scene));
}

bool FRenderTest::Load(FSceneDescription Scene)
{
	const std::string Fault = ValidateScene(Scene);
	EXPECT_EQ(Fault, "");
	if (!Fault.empty()) { return false; }
	const FRTStatus Status = GetEngine().Load(std::move(Scene));
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	if (!Status) { return false; }
	const FSceneDescription& Description = GetScene().GetDescription();
	FSunLight Sun;
	if (Description.DefaultSun)
	{
		Sun.Direction = glm::dvec3(*Description.DefaultSun);
		Sun.Irradiance = Description.DefaultSun->w;
		Sun.AngularDiameter = glm::radians(Description.DefaultSunDiameter);
	}
	GetScene().SetSun(Sun);
	SetSky(Description.DefaultSky.value_or(glm::vec3(0)));
	return true;
}

void FRenderTest::SetSun(double DiameterDegrees, float Irradiance, glm::dvec3 Direction)
{
	FSunLight Sun;
	Sun.Direction = Direction;
	Sun.Irradiance = Irradiance;
	Sun.AngularDiameter = static_cast<float>(glm::radians(DiameterDegrees));
	GetScene().SetSun(Sun);
}

void FRenderTest::SetSky(glm::vec3 Radiance) { GetScene().GetScene().SetSky(Radiance); }

FSceneLight FRenderTest::MakeLamp(const glm::dvec3& Position, glm::vec3 Intensity, float Radius)
{
	FSceneLight Light;
	Light.Position = Position;
	Light.Color = Intensity;
	if (Radius > 0.0f)
	{
		Light.Type = LIGHT_SPHERE;
		Light.Size = {Radius, 0};
		Light.Color *= 1.0f / (3.14159265f * Radius * Radius);
	}
	return Light;
}

void FRenderTest::SetVariable(const char* Name, const std::string& Value)
{
	const auto Fault = FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test");
	EXPECT_FALSE(Fault.has_value()) << *Fault;
}

void FRenderTest::Dispatch(
    IRTPipeline* Pipeline, const void* Push, uint32_t PushBytes, uint32_t GroupsX, uint32_t GroupsY, IRTBuffer* Results)
{
	TRTRef<IRTCommandList> List;
	ASSERT_OK(GetDevice().CreateCommandList("Dispatch", List.ReleaseAndGetAddress()));
	ASSERT_OK(List->Begin());
	List->SetPipeline(Pipeline);
	List->PushConstants(Push, PushBytes);
	List->Dispatch(GroupsX, GroupsY, 1);
	const FRTBarrier Back{Results, nullptr, ERTAccess::StorageWrite, ERTAccess::HostRead};
	List->Barriers(&Back, 1);
	ASSERT_OK(List->End());
	IRTCommandList* const Lists[] = {List.Get()};
	FRTFence Fence = 0;
	ASSERT_OK(GetDevice().Submit(Lists, 1, &Fence));
	ASSERT_OK(GetDevice().WaitFor(Fence, ~0ull));
}

namespace
{
/// After a failure tests go on with a black picture, rather than reading past the end of none.
bool HasSize(const FImage& Image, const FView& View) { return Image.Width == View.Width && Image.Height == View.Height; }
} // namespace

FImage FRenderTest::RenderLighting(const FView& View, double Time)
{
	FCapturedFrame Frame;
	FFrameCapture Capture;
	Capture.bLighting = true;
	EXPECT_OK(GetEngine().RenderFrame(View, Time, Capture, &Frame));
	return HasSize(Frame.Lighting, View) ? std::move(Frame.Lighting) : FImage(View.Width, View.Height, 3);
}

FImage FRenderTest::RenderLightingFine(FView View, uint32_t Factor, double Time)
{
	View.Width *= Factor;
	View.Height *= Factor;
	return Shrink(RenderLighting(View, Time), Factor);
}

FImage FRenderTest::RenderSunShadow(const FView& View, uint32_t Count, uint32_t First, double Time)
{
	return RenderSignal(ESignal::SunShadow, View, Count, First, Time);
}

FImage FRenderTest::RenderSignal(ESignal Signal, const FView& View, uint32_t Count, uint32_t First, double Time)
{
	FImage Sum(View.Width, View.Height, GetSignalInfo(Signal).Channels);
	GetEngine().SetFrameIndex(First);
	for (uint32_t I = 0; I < Count; ++I)
	{
		FFrameCapture Capture;
		Capture.Signals.Add(Signal);
		FCapturedFrame Frame;
		EXPECT_OK(GetEngine().RenderFrame(View, Time, Capture, &Frame));
		const FImage& Picture = Frame.Get(Signal);
		EXPECT_EQ(Picture.Pixels.size(), Sum.Pixels.size()) << "the frame has no " << GetSignalInfo(Signal).Name;
		if (Picture.Pixels.size() != Sum.Pixels.size()) { return Sum; }
		for (size_t P = 0; P < Sum.Pixels.size(); ++P) { Sum.Pixels[P] += Picture.Pixels[P] / static_cast<float>(Count); }
	}
	return Sum;
}

FImage FRenderTest::TraceReference(const FReferenceSettings& Settings)
{
	FReferenceResult Result;
	EXPECT_OK(RenderReference(GetEngine(), Settings, Result));
	FImage Black(Settings.View.Width, Settings.View.Height, GetSignalInfo(Settings.Signal).Channels);
	EXPECT_EQ(Result.Radiance.Pixels.size(), Black.Pixels.size());
	return Result.Radiance.Pixels.size() == Black.Pixels.size() ? std::move(Result.Radiance) : Black;
}

FImage FRenderTest::TraceReference(const FView& View, uint32_t Samples, uint32_t Bounces, double Time)
{
	FReferenceSettings Settings;
	Settings.View = View;
	Settings.Time = Time;
	Settings.Samples = Samples;
	Settings.Bounces = Bounces;
	return TraceReference(Settings);
}

FEstimate FRenderTest::EstimateMean(FView View, uint32_t Samples, uint32_t Bounces, uint32_t Batches)
{
	std::vector<double> Means;
	for (uint32_t Batch = 0; Batch < Batches; ++Batch)
	{
		View.Seed = 1 + Batch;
		Means.push_back(MeanGreen(TraceReference(View, Samples, Bounces)));
	}
	return MakeEstimate(Means);
}

double MeanGreen(const FImage& Image)
{
	double Sum = 0.0;
	for (size_t I = 0; I < Image.GetPixelCount(); ++I) { Sum += Image.Pixels[I * Image.Channels + (Image.Channels == 1 ? 0 : 1)]; }
	return Sum / double(Image.GetPixelCount());
}

double MaxDifference(const FImage& A, const FImage& B)
{
	EXPECT_EQ(A.Pixels.size(), B.Pixels.size());
	double Max = 0.0;
	for (size_t I = 0; I < std::min(A.Pixels.size(), B.Pixels.size()); ++I)
	{
		const double Difference = std::abs(double(A.Pixels[I]) - B.Pixels[I]);
		Max = Difference <= Max ? Max : Difference; // a NaN stays
	}
	return Max;
}

double FractionDiffering(const FImage& A, const FImage& B, double Threshold)
{
	EXPECT_EQ(A.Pixels.size(), B.Pixels.size());
	size_t Count = 0;
	for (size_t I = 0; I < std::min(A.GetPixelCount(), B.GetPixelCount()); ++I)
	{
		bool bDiffers = false;
		for (uint32_t C = 0; C < A.Channels; ++C)
		{
			const double Difference = std::abs(double(A.Pixels[I * A.Channels + C]) - B.Pixels[I * B.Channels + C]);
			bDiffers |= !(Difference <= Threshold);
		}
		Count += bDiffers ? 1 : 0;
	}
	return double(Count) / double(A.GetPixelCount());
}

FImage Shrink(const FImage& Image, uint32_t Factor)
{
	FImage Out(Image.Width / Factor, Image.Height / Factor, Image.Channels, Image.Space);
	const float Weight = 1.0f / static_cast<float>(Factor * Factor);
	for (uint32_t Y = 0; Y < Out.Height * Factor; ++Y)
	{
		for (uint32_t X = 0; X < Out.Width * Factor; ++X)
		{
			for (uint32_t C = 0; C < Out.Channels; ++C) { Out.At(X / Factor, Y / Factor, C) += Image.At(X, Y, C) * Weight; }
		}
	}
	return Out;
}

} // namespace Lantern
