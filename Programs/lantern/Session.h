// What the commands share: console variables from files and command line, a device, a scene in the sample engine.
#pragma once

#include <memory>
#include <string>

#include "LanternHost/SampleEngine.h"
#include "Options.h"

namespace Lantern
{

/// Folders of the plugin, found from where the program is.
struct FPluginFolders
{
	std::string Root, Shaders, Config, Cache;
	/// Folder for compiled shaders; empty without a cache.
	std::string GetShaderCache() const { return Cache.empty() ? "" : Cache + "/shaders"; }
	FRendererDesc DescribeRenderer() const { return {{Shaders}, GetShaderCache()}; }
};
FPluginFolders FindPluginFolders();

class FSession
{
public:
	~FSession();
	/// Each returns an exit status; what went wrong has been said.
	int OpenDevice(const FDeviceOptions& Options);
	int LoadScene(const FPictureOptions& Options);
	/// Adds a failed exit status where validation spoke. Call last.
	int Close(int Status);

	IRTDevice& GetDevice() { return *Device; }
	FSampleEngine& GetEngine() { return *Engine; }
	FView MakeView(const FPictureOptions& Options) const;
	/// Names scene, light and console variables: what a reference of Signal depends on beside its view.
	std::string MakeSceneKey(const FPictureOptions& Options, ESignal Signal) const;
	double GetLoadSeconds() const { return LoadSeconds; }

private:
	void ApplyLight(const FPictureOptions& Options, const FSceneDescription& Description);

	FPluginFolders Folders;
	TRTRef<IRTDevice> Device;
	std::unique_ptr<FSampleEngine> Engine;
	uint32_t ValidationMessages = 0;
	float DefaultExposure = 0.0f;
	double LoadSeconds = 0.0;
};

/// A bare device for measuring how long it compiles: the driver's own caches are off, ours too. LANTERN_DEVICE as above.
FRTStatus OpenUncachedDevice(const FDeviceOptions& Options, TRTRef<IRTDevice>& Out);

/// Sets console variables: the folder's defaults, --config, --quality, --set. An exit status.
int LoadSettings(const std::string& ConfigFolder, const FDeviceOptions& Options);

/// The exit status that fits an error, after logging it.
int ReportStatus(const FRTStatus& Status, const char* What);

} // namespace Lantern
