// The user chooses the sample count.
#include "swapchain.h"

static SwapChain* instance;

SwapChain* SwapChain::Get() {
    if (!instance)
        instance = new SwapChain();
    return instance;
}

enum class Antialiasing { Off, X2 = 2, X4 = 4, X8 = 8 };

void applySettings(Antialiasing wanted) {
    switch (wanted) {
        case Antialiasing::Off:
            SwapChain::Get()->SetSamples(1);
            break;
        default:
            SwapChain::Get()->SetSamples(static_cast<int>(wanted));
    }
}
