// Drops a file onto a window as a file manager would, by the XDND protocol (version 5): drop_file WINDOW_NAME
// FILE. Ends with 0 once the window has taken it.
#include <X11/Xatom.h>
#include <X11/Xlib.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string>
#include <thread>

namespace {

struct Drop {
    Display* display = nullptr;
    Window source = 0;
    Window target = 0;
    std::string uris;  // text/uri-list

    Atom atom(const char* name) const { return XInternAtom(display, name, False); }
};

// Window managers may stand between the root and the window that is meant.
std::optional<Window> findWindow(Display* display, Window under, const char* part) {
    char* name = nullptr;
    if (XFetchName(display, under, &name) && name) {
        const bool found = std::strstr(name, part) != nullptr;
        XFree(name);
        if (found) return under;
    }
    Window root = 0, parent = 0;
    Window* children = nullptr;
    unsigned count = 0;
    std::optional<Window> found;
    if (XQueryTree(display, under, &root, &parent, &children, &count)) {
        for (unsigned i = 0; i < count && !found; ++i) found = findWindow(display, children[i], part);
        if (children) XFree(children);
    }
    return found;
}

void send(const Drop& drop, const char* type, const std::array<long, 5>& data) {
    XEvent event{};
    event.xclient.type = ClientMessage;
    event.xclient.window = drop.target;
    event.xclient.message_type = drop.atom(type);
    event.xclient.format = 32;
    for (std::size_t i = 0; i < data.size(); ++i) event.xclient.data.l[i] = data[i];
    XSendEvent(drop.display, drop.target, False, NoEventMask, &event);
    XFlush(drop.display);
}

void answerRequest(const Drop& drop, const XSelectionRequestEvent& request) {
    XChangeProperty(drop.display, request.requestor, request.property, request.target, 8, PropModeReplace,
                    reinterpret_cast<const unsigned char*>(drop.uris.data()),
                    static_cast<int>(drop.uris.size()));
    XEvent reply{};
    reply.xselection.type = SelectionNotify;
    reply.xselection.requestor = request.requestor;
    reply.xselection.selection = request.selection;
    reply.xselection.target = request.target;
    reply.xselection.property = request.property;
    reply.xselection.time = request.time;
    XSendEvent(drop.display, request.requestor, False, NoEventMask, &reply);
    XFlush(drop.display);
}

// Drops once the window says that it would take it. False after 20 seconds.
bool carryOut(const Drop& drop) {
    const long source = static_cast<long>(drop.source);
    send(drop, "XdndEnter", {source, 5L << 24, static_cast<long>(drop.atom("text/uri-list")), 0, 0});
    const std::array<long, 5> position = {source, 0, (40L << 16) | 40, CurrentTime,
                                          static_cast<long>(drop.atom("XdndActionCopy"))};
    send(drop, "XdndPosition", position);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < end) {
        if (XPending(drop.display) == 0) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            continue;
        }
        XEvent event;
        XNextEvent(drop.display, &event);
        if (event.type == SelectionRequest) answerRequest(drop, event.xselectionrequest);
        if (event.type != ClientMessage) continue;
        if (event.xclient.message_type == drop.atom("XdndStatus"))
            send(drop, "XdndDrop", {source, 0, CurrentTime, 0, 0});
        if (event.xclient.message_type == drop.atom("XdndFinished")) return true;
    }
    return false;
}

}  // namespace

int main(int argumentCount, char** arguments) {
    if (argumentCount != 3) return 2;
    Drop drop;
    drop.display = XOpenDisplay(nullptr);
    if (!drop.display) return 2;
    drop.source = XCreateSimpleWindow(drop.display, DefaultRootWindow(drop.display), 0, 0, 8, 8, 0, 0, 0);
    const std::optional<Window> target =
        findWindow(drop.display, DefaultRootWindow(drop.display), arguments[1]);
    if (!target) {
        std::fprintf(stderr, "drop_file: no window is named %s\n", arguments[1]);
        return 2;
    }
    drop.target = *target;
    drop.uris = std::string("file://") + arguments[2] + "\r\n";
    XSetSelectionOwner(drop.display, drop.atom("XdndSelection"), drop.source, CurrentTime);
    const bool taken = carryOut(drop);
    XCloseDisplay(drop.display);
    return taken ? 0 : 1;
}
